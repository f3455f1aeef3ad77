#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "figure/figure_scene.hpp"
#include "figure/figures.hpp"
#include "figure/notes.hpp"
#include "figure/sheet.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/image.hpp"
#include "halfspace/io/figure.hpp"
#include "halfspace/result.hpp"
#include "halfspace/visible_map.hpp"
#include "image/clipping.hpp"
#include "image/scalars.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {

/// What `draw` is asked for, completed.
struct DrawArguments {
  std::vector<std::string> paths;
  std::string output;
  std::string by;
  std::string fill;
  std::string lines;
  std::optional<Hidden> hidden;
  std::optional<double> crease_deg;
  std::optional<CutPlane> cut;
  bool axes = false;
  std::string notes;
  std::optional<double> text_size;
  double line_width = 1;
  bool titles = false;
  int decimals = 3;
  double levels = 2;
  std::vector<std::uint8_t> alphas;  ///< one for all, or one a file
  bool certificate = false;
  std::size_t most_cells = fast::MapLimits{}.most_cells;
  std::optional<int> grid_bits;
  ViewArguments view;
  ClipArguments clip;
  SheetArguments sheet;
  ScalarArguments scalars;
};

/// Whether regions may have the colours of their polygon's corners.
bool can_shade(const std::string& by);

/// The height of lines of text in a figure of one view.
constexpr double kUsualTextPx = 12;

/// Makes one figure of all views.
class ViewFigure {
 public:
  /// Requires: all three stay where they are.
  ViewFigure(const DrawArguments& arguments, const FigureScene& scene,
             const ImageOptions& image);

  /// Adds one view. Errors: those of the map, the drawing and the clip planes;
  /// kStopped if interrupted.
  Result<Done> add(const Camera& camera, const Placing& placing, bool on_sheet);

  io::Figure& figure() { return figure_; }
  std::size_t regions() const { return regions_; }
  std::size_t arcs() const { return arcs_; }
  std::size_t strokes() const { return strokes_; }

 private:
  StrokeStyle stroke_style(bool on_sheet) const;
  /// Axes, and what the file of notes says.
  Result<Done> add_axes_and_notes(const Camera& camera, const Placing& placing,
                                  bool on_sheet);
  /// Notes, of which clip planes take nothing away if they are whole.
  Result<Done> add_given(const Notes& notes, bool whole, const Camera& camera,
                         const Placing& placing, bool on_sheet);
  Result<Done> add_edges(const Camera& camera, const Placing& placing,
                         bool on_sheet);
  Result<Done> add_map(const Camera& camera, const Placing& placing,
                       bool on_sheet);
  Result<Done> add_hatched(const Camera& camera, const Placing& placing,
                           const std::vector<bool>& cuts, double gap,
                           double width);
  /// The tree, built when it is first asked for; nothing if interrupted.
  const fast::BspTree* tree();
  /// Whether polygons let something through: all as --alpha says, or each as
  /// its file does, where regions have the polygons' own colours.
  bool composes() const;
  /// What of polygons and caps is not seen through, if something is.
  TransparentOptions transparency(const ImageOptions& section) const;
  /// `section` becomes what clip planes and caps there are.
  Result<fast::VisibleMap> filled_map(const Camera& camera,
                                      ImageOptions& section);

  const DrawArguments& arguments_;
  const FigureScene& scene_;
  const ImageOptions& image_;
  bool smooth_;
  io::Figure figure_;
  std::optional<fast::BspTree> tree_;
  std::size_t regions_ = 0;
  std::size_t arcs_ = 0;
  std::size_t strokes_ = 0;
};

}  // namespace halfspace::tools
