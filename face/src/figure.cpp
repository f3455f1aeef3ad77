#include "halfspace/io/figure.hpp"

#include <map>
#include <utility>

#include "display_state.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/image/transparent_map.hpp"
#include "halfspace/fast/visible_map.hpp"

/// Figures of a display: what is seen as regions.
namespace halfspace {
namespace {

/// Numbers colours in the order in which they come.
class ColorKeys {
 public:
  std::int32_t of(const Rgb& color) {
    const auto next = static_cast<std::int32_t>(keys_.size());
    return keys_.try_emplace(color, next).first->second;
  }

 private:
  std::map<Rgb, std::int32_t> keys_;
};

}  // namespace

Result<Done> Figure::save(const std::filesystem::path& path) const {
  io::Figure figure;
  figure.width = width_px;
  figure.height = height_px;
  for (const SeenRegion& region : regions) {
    io::FigureRegion drawn;
    drawn.fill = region.color;
    drawn.is_background = region.polygon == kBackground;
    drawn.title = drawn.is_background ? "background"
                  : region.polygon == kComposed
                      ? "composed"
                      : "polygon " + std::to_string(region.polygon);
    for (const std::vector<Point2>& loop : region.loops) {
      auto& points = drawn.loops.emplace_back();
      for (const Point2& p : loop) points.push_back({p.x, p.y});
    }
    figure.regions.push_back(std::move(drawn));
  }
  if (!lines.empty()) {
    io::FigureStrokes strokes;
    for (const DrawnLine& line : lines) {
      if (line.layers > 0) continue;
      strokes.strokes.push_back(
          {{line.from.x, line.from.y}, {line.to.x, line.to.y}, {}});
    }
    io::order_for_pen(strokes.strokes);
    figure.strokes.push_back(std::move(strokes));
  }
  return io::write_figure(path, figure);
}

std::vector<std::int32_t> Display::State::keys_of(
    FigureKey by, const ImageOptions& options) const {
  std::vector<std::int32_t> keys;
  ColorKeys colors;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const std::int32_t polygon = polygon_of(id);
    keys.push_back(by == FigureKey::kPolygon ? polygon
                   : by == FigureKey::kSolid ? solid_of(polygon)
                                             : colors.of(scene.color(id)));
  }
  for (std::size_t k = 0; k < cap_item_count(options); ++k) {
    keys.push_back(by == FigureKey::kColor
                       ? colors.of(color_of(options, cap_item(k)))
                       : static_cast<std::int32_t>(polygon_count + k));
  }
  return keys;
}

namespace {

/// The loops of a region, as the face hands them out.
std::vector<std::vector<Point2>> points_of(const fast::VisibleMap& map,
                                           const fast::MapRegion& region) {
  std::vector<std::vector<Point2>> loops;
  for (const auto& loop : fast::loops_of(map, region)) {
    std::vector<Point2>& points = loops.emplace_back();
    for (const auto& [x, y] : loop) points.push_back({x, y});
  }
  return loops;
}

/// What is seen through polygons, in regions of one colour (S7.8).
Result<Figure> composed_figure(const Scene& scene, const fast::BspTree& tree,
                               const Camera& camera,
                               const ImageOptions& options, const View& view) {
  const auto map = fast::transparent_section(
      scene, tree, camera, {view.cull, view.alpha, view.background}, options);
  if (!map) return map.error();
  Figure figure{view.width_px, view.height_px, {}, {}};
  for (const fast::MapRegion& region : map->regions) {
    const bool is_background = region.item == kBackground;
    figure.regions.push_back(
        {is_background ? kBackground : kComposed,
         is_background ? view.background : color_of_key(region.key),
         points_of(*map, region)});
  }
  return figure;
}

}  // namespace

Result<Figure> Display::figure(const View& view, FigureKey by) const {
  if (view.back_color) return detail::no_marks();
  const Result<Camera> camera = detail::camera_of(state_->scene, view);
  if (!camera) return camera.error();
  const Result<ImageOptions> options = state_->options_of(view);
  if (!options) return options.error();
  const fast::BspTree* tree = state_->ordered_tree(view);
  if (tree == nullptr) return detail::stopped();
  const Scene& scene = state_->scene;
  if (view.alpha != kOpaque)
    return composed_figure(scene, *tree, *camera, *options, view);
  const auto map =
      fast::section_map(scene, *tree, *camera,
                        {view.cull, state_->keys_of(by, *options)}, *options);
  if (!map) return map.error();
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  Figure figure{view.width_px, view.height_px, {}, {}};
  for (const fast::MapRegion& region : map->regions) {
    SeenRegion& seen = figure.regions.emplace_back();
    if (region.item == kBackground) {
      seen.polygon = kBackground;
      seen.color = view.background;
    } else if (region.item < count) {
      seen.polygon = state_->polygon_of(region.item);
      seen.color = scene.color(region.item);
    } else {
      CapItem cap = cap_item(static_cast<std::size_t>(region.item - count));
      seen.color = color_of(*options, cap);
      cap.is_hatched = false;
      seen.polygon = state_->polygon_of(count + number_of(cap));
    }
    seen.loops = points_of(*map, region);
  }
  return figure;
}

}  // namespace halfspace
