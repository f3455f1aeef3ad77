#pragma once

#include <vector>

#include "figure/figures.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/io/figure.hpp"
#include "halfspace/scalars.hpp"
#include "halfspace/scene.hpp"

/// Numbers over a scene in the colours of a scale (S11), as regions.
namespace halfspace::tools {

/// By polygon whether its colours differ within it: whether steps of the scale
/// lie between the numbers of its corners.
std::vector<bool> banded_polygons(const Scene& scene, const ScalarField& field,
                                  const ColorScale& scale);

/// The scene in which every polygon of one number has its colour (S11.4).
Scene scalar_scene(const Scene& scene, const ShownScalars& scalars);

/// Cuts the regions that show one polygon into bands of one colour.
class BandCutter {
 public:
  /// Requires: a scene whose polygons have the colours of the light on them;
  ///           all stay where they are.
  BandCutter(const Scene& scene, const Camera& camera,
             const ShownScalars& scalars);

  /// The region's bands, each with the colour of S11.4. Where a step's line is,
  /// doubles tell.
  /// Requires: the polygon's numbers differ, and none is missing.
  std::vector<io::FigureRegion> cut(const io::FigureRegion& region,
                                    PolygonId polygon,
                                    const Placing& placing) const;

 private:
  const Scene& scene_;
  const Camera& camera_;
  const ShownScalars& scalars_;
  Scene shares_;  ///< whose corners are red, green and blue
};

}  // namespace halfspace::tools
