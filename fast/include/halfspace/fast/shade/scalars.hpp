#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scalars.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// A scalar field in the colours of a scale, prepared for images of the scene.
struct ScalarColors {
  ScalarField field;
  ColorScale scale;
  /// By polygon: the class of all of it, as an index into `colors`, or -1 where
  /// its corners have several.
  std::vector<std::int32_t> classes;
  /// By class: what is below the limits, the scale's colours in order, what is
  /// above the limits, and no data.
  std::vector<Rgb> colors;
};

/// Requires: a field of the scene (make_scalars()); is_valid(scale).
/// Cost:     linear.
ScalarColors prepare_scalars(const Scene& scene, ScalarField field,
                             ColorScale scale);

/// Which part of an image items are, and how they are coloured.
struct ScalarOptions {
  std::int32_t samples = 1;  ///< items a pixel each way: 1, 2, 4 or 8
  std::int32_t left = 0;     ///< the column of the first pixel
  std::int32_t top = 0;      ///< its line
  int threads = 1;
};

/// The colours of an item image, by scalars (S11.4).
///
/// It is made after the image, from the items alone, so no image without
/// scalars takes longer for it.
/// Requires: items of the scene, the camera and these options.
/// Exact:    yes: a scalar's class and a channel's rounding in doubles with a
///           bound, and in rationals where that touches a step.
/// Cost:     that of the pixels seen; only polygons whose corners lie in
///           several classes, or are lit differently, are interpolated.
ColorImage color_scalars(const Scene& scene, const Camera& camera,
                         const ImageOptions& options, const ItemImage& items,
                         const ScalarColors& scalars,
                         const ScalarOptions& how = {});

/// The same into an image that is there; returns what was decided how.
FilterStats color_scalars(const Scene& scene, const Camera& camera,
                          const ImageOptions& options, const ItemImage& items,
                          const ScalarColors& scalars, const ScalarOptions& how,
                          ColorImage& colors);

}  // namespace halfspace::fast
