#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/image.hpp"
#include "halfspace/io/figure.hpp"
#include "halfspace/scene_file.hpp"
#include "image/scalars.hpp"

namespace halfspace::tools {

/// A scene of several files, and how its figures show it.
struct FigureScene {
  SceneFile file;                   ///< with the camera of a .scene
  std::vector<std::int32_t> files;  ///< by polygon
  /// By polygon how opaque the file says that it is, of 255; empty: all of it.
  std::vector<std::uint8_t> alphas;
  std::string name;                     ///< of the first file
  std::optional<ShownScalars> scalars;  ///< what colours show, if numbers
  const Scene& scene() const { return file.scene; }
};

/// The keys by which regions are joined (S7.3): `polygon` (none), `face`,
/// `colour`, `part`, `file` or `all`. With `smooth` a polygon whose corners
/// differ in colour is joined by `colour` to none. With caps in the options of
/// an image there are keys of theirs, and of their hatching (S10.5), too.
std::vector<std::int32_t> keys_of(const FigureScene& scene,
                                  const std::string& by, bool smooth = false,
                                  const ImageOptions& image = {});

/// Where a view stands on the figure: image points are scaled, then moved.
struct Placing {
  double x = 0;
  double y = 0;
  double scale = 1;
  io::FigurePoint at(double px, double py) const {
    return {x + scale * px, y + scale * py};
  }
};

/// How regions are filled.
struct FillStyle {
  std::string by;  ///< what joined them
  Rgb background;
  bool has_background = true;  ///< whether regions that show nothing are added
  /// The view, where polygons have Gouraud shading.
  const Camera* smooth_view = nullptr;
  /// The view, where numbers are shown.
  const Camera* scalar_view = nullptr;
  const ImageOptions* caps = nullptr;  ///< how caps look, if the map has any
};

/// Adds the regions of a map, with ids, and titles and classes by what joined
/// them. Of parts and files each has a colour of its own; else a region has its
/// lowest polygon's.
void add_regions(io::Figure& figure, const fast::VisibleMap& map,
                 const FigureScene& scene, const FillStyle& style,
                 const Placing& placing);

/// A plane across an axis, in the model's units.
struct CutPlane {
  int axis = 0;
  double at = 0;
};

/// By polygon whether all its corners have the grid's coordinate that is
/// nearest to the plane's.
std::vector<bool> cuts_of(const Scene& scene, const CutPlane& plane);

/// Hatches the regions of a map with key 1. Units: those of the figure.
void add_hatching(io::Figure& figure, const fast::VisibleMap& map, double gap,
                  double width, const Placing& placing);

/// Adds the borders of a map's regions.
void add_borders(io::Figure& figure, const fast::VisibleMap& map, double width,
                 const Placing& placing);

/// How hidden strokes are drawn.
enum class Hidden { kGone, kDashed, kSolid };

/// How strokes are drawn. Units: those of the figure.
struct StrokeStyle {
  double width = 1;
  Hidden hidden = Hidden::kGone;
  bool titles = false;  ///< names the edges and intervals of each stroke
};

/// Adds the strokes of a drawing, a layer for each class and for what of it is
/// hidden, in an order for a pen.
void add_strokes(io::Figure& figure, const fast::Drawing& drawing,
                 const StrokeStyle& style, const Placing& placing);

}  // namespace halfspace::tools
