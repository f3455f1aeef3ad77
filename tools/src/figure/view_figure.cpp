#include "figure/view_figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "cli/long_work.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/image/transparent_map.hpp"
#include "halfspace/io/load_scene.hpp"
#include "image/engine.hpp"

namespace halfspace::tools {
namespace {

/// The width of a line of 1 on a sheet.
constexpr double kSheetLineMm = 0.35;

DrawingOptions drawing_options(const DrawArguments& arguments, bool cull) {
  constexpr double kUsualCrease = 20;
  const double angle =
      arguments.crease_deg.value_or(kUsualCrease) * std::numbers::pi / 180;
  DrawingOptions options;
  options.cull = cull;
  options.crease_cosine = static_cast<std::int32_t>(
      std::lround(std::ldexp(std::cos(angle), kCosineBits)));
  return options;
}

}  // namespace

bool can_shade(const std::string& by) {
  return by == "colour" || by == "polygon";
}

ViewFigure::ViewFigure(const DrawArguments& arguments, const FigureScene& scene,
                       const ImageOptions& image)
    : arguments_(arguments),
      scene_(scene),
      image_(image),
      smooth_(image.shading == Shading::kGouraud &&
              !scene.scene().data().corner_colors.empty() &&
              can_shade(arguments.by)) {}

Result<Done> ViewFigure::add(const Camera& camera, const Placing& placing,
                             bool on_sheet) {
  const bool has_map =
      arguments_.fill != "none" || arguments_.lines == "regions";
  if (has_map) {
    if (const Result<Done> done = add_map(camera, placing, on_sheet); !done)
      return done;
  }
  if (const auto done = add_axes_and_notes(camera, placing, on_sheet); !done)
    return done;
  if (arguments_.lines != "edges") return Done{};
  return add_edges(camera, placing, on_sheet);
}

Result<Done> ViewFigure::add_edges(const Camera& camera, const Placing& placing,
                                   bool on_sheet) {
  DrawingOptions options = drawing_options(arguments_, image_.cull);
  if (arguments_.cut) options.cuts = cuts_of(scene_.scene(), *arguments_.cut);
  ImageOptions section;
  const Result<Done> clipped =
      add_clips(scene_.scene(), camera, arguments_.clip, section);
  if (!clipped) return clipped.error();
  options.clips = section.clips;
  options.caps = section.caps.has_value();
  const Result<fast::Drawing> drawing =
      fast::draw(scene_.scene(), camera, options);
  if (!drawing) return drawing.error();
  const StrokeStyle style = stroke_style(on_sheet);
  add_strokes(figure_, *drawing, style, placing);
  strokes_ += drawing->strokes.size();
  if (!arguments_.cut) return Done{};
  const double gap = on_sheet ? 2.5 : 8;
  return add_hatched(camera, placing, options.cuts, gap, style.width * 0.5);
}

StrokeStyle ViewFigure::stroke_style(bool on_sheet) const {
  StrokeStyle style;
  style.width = arguments_.line_width * (on_sheet ? kSheetLineMm : 1);
  style.hidden = arguments_.hidden.value_or(Hidden::kGone);
  style.titles = arguments_.titles;
  return style;
}

Result<Done> ViewFigure::add_axes_and_notes(const Camera& camera,
                                            const Placing& placing,
                                            bool on_sheet) {
  if (arguments_.axes) {
    Notes axes;
    add_axes(axes, scene_.scene(), camera);
    const auto done = add_given(axes, true, camera, placing, on_sheet);
    if (!done) return done;
  }
  if (arguments_.notes.empty()) return Done{};
  const Result<Notes> notes = read_notes(arguments_.notes, scene_.scene());
  if (!notes) return io::error_about(arguments_.notes, notes.error());
  return add_given(*notes, false, camera, placing, on_sheet);
}

Result<Done> ViewFigure::add_given(const Notes& notes, bool whole,
                                   const Camera& camera, const Placing& placing,
                                   bool on_sheet) {
  if (notes.empty()) return Done{};
  ImageOptions section;
  const Result<Done> clipped =
      add_clips(scene_.scene(), camera, arguments_.clip, section);
  if (!clipped) return clipped.error();
  DrawingOptions options;
  options.cull = image_.cull;
  options.edges = false;
  options.lines = notes.lines;
  options.points = notes.points;
  options.clips = section.clips;
  options.caps = section.caps.has_value();
  options.whole = whole;
  const Result<fast::Drawing> drawing =
      fast::draw(scene_.scene(), camera, options);
  if (!drawing) return drawing.error();
  constexpr double kUsualTextMm = 3.5;
  const double size =
      arguments_.text_size.value_or(on_sheet ? kUsualTextMm : kUsualTextPx);
  add_notes(figure_, *drawing, notes, size, stroke_style(on_sheet), placing);
  strokes_ += drawing->strokes.size();
  return Done{};
}

const fast::BspTree* ViewFigure::tree() {
  if (!tree_) {
    LongWork work("building the tree");
    fast::DisplayTreeOptions display;
    display.leaf_size = kDividedLeaf;
    // 5,000 triangles that cross each other are drawn in 0.82 of the time that
    // the usual 8 take, others in 0.9 to 1.02.
    display.own_planes = 2;
    display.progress = [&work](double share) { return work.report(share); };
    tree_ = fast::build_display_tree(scene_.scene(), display);
    if (LongWork::interrupted()) return nullptr;
  }
  return &*tree_;
}

Result<Done> ViewFigure::add_hatched(const Camera& camera,
                                     const Placing& placing,
                                     const std::vector<bool>& cuts, double gap,
                                     double width) {
  const fast::BspTree* made = tree();
  if (made == nullptr) return Error{ErrorCode::kStopped, "interrupted"};
  const Result<fast::VisibleMap> map = fast::visible_map(
      scene_.scene(), *made, camera, {image_.cull, {cuts.begin(), cuts.end()}},
      {arguments_.most_cells});
  if (!map) return map.error();
  add_hatching(figure_, *map, gap, width, placing);
  return Done{};
}

bool ViewFigure::composes() const {
  if (!arguments_.alphas.empty()) return true;
  return !scene_.alphas.empty() && arguments_.by == "colour" &&
         image_.shading == Shading::kFlat && !scene_.scalars;
}

TransparentOptions ViewFigure::transparency(const ImageOptions& section) const {
  const std::vector<std::uint8_t>& given = arguments_.alphas;
  TransparentOptions options = {image_.cull, kOpaque, image_.background};
  if (given.empty()) {
    options.alphas = scene_.alphas;
  } else if (given.size() == 1) {
    options.alpha = given[0];
    return options;
  } else {
    for (const std::int32_t file : scene_.files)
      options.alphas.push_back(given[static_cast<std::size_t>(file)]);
  }
  if (!section.caps) return options;
  // Caps are like what they are of, and where several are like what hides most.
  const std::uint8_t most =
      *std::max_element(options.alphas.begin(), options.alphas.end());
  options.cap_alphas.assign(1, most);
  if (!section.parts) return options;
  options.cap_alphas.assign(section.parts->count() + 1, 0);
  options.cap_alphas.back() = most;
  for (std::size_t p = 0; p < options.alphas.size(); ++p) {
    std::uint8_t& alpha = options.cap_alphas[section.parts->part_of[p]];
    alpha = std::max(alpha, options.alphas[p]);
  }
  return options;
}

Result<fast::VisibleMap> ViewFigure::filled_map(const Camera& camera,
                                                ImageOptions& section) {
  const fast::BspTree* made = tree();
  if (made == nullptr) return Error{ErrorCode::kStopped, "interrupted"};
  const fast::MapLimits limits = {arguments_.most_cells};
  section = image_;
  const Result<Done> clipped =
      add_clips(scene_.scene(), camera, arguments_.clip, section);
  if (!clipped) return clipped.error();
  if (composes()) {
    return fast::transparent_section(scene_.scene(), *made, camera,
                                     transparency(section), section, limits);
  }
  return fast::section_map(
      scene_.scene(), *made, camera,
      {image_.cull, keys_of(scene_, arguments_.by, smooth_, section)}, section,
      limits);
}

Result<Done> ViewFigure::add_map(const Camera& camera, const Placing& placing,
                                 bool on_sheet) {
  ImageOptions section;
  const Result<fast::VisibleMap> map = filled_map(camera, section);
  if (!map) return map.error();
  regions_ += map->regions.size();
  arcs_ += map->arcs.size();
  if (arguments_.fill != "none") {
    FillStyle style;
    style.by = composes() ? "composed" : arguments_.by;
    style.background = image_.background;
    style.has_background = !on_sheet;
    style.smooth_view = smooth_ ? &camera : nullptr;
    style.scalar_view = scene_.scalars ? &camera : nullptr;
    style.caps = &section;
    add_regions(figure_, *map, scene_, style, placing);
  }
  if (arguments_.lines == "regions")
    add_borders(figure_, *map, arguments_.line_width, placing);
  return Done{};
}

}  // namespace halfspace::tools
