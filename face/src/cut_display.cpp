#include "halfspace/cut_display.hpp"

#include <algorithm>
#include <utility>

#include "display_state.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/seen_areas.hpp"
#include "halfspace/fast/order_feed.hpp"
#include "halfspace/fast/visible_map.hpp"

namespace halfspace {

struct [[gnu::visibility("hidden")]] CutDisplay::State {
  const Display* display = nullptr;
  fast::BspTree tree;  ///< without leaves
  fast::FragmentVertices vertices;
};

CutDisplay::CutDisplay(std::unique_ptr<State> state)
    : state_(std::move(state)) {}
CutDisplay::CutDisplay(CutDisplay&&) noexcept = default;
CutDisplay& CutDisplay::operator=(CutDisplay&&) noexcept = default;
CutDisplay::~CutDisplay() = default;

Result<CutDisplay> CutDisplay::of(const Display& display,
                                  const WorkOptions& options) {
  auto state = std::make_unique<State>();
  state->display = &display;
  fast::DisplayTreeOptions how;
  how.threads = std::max(options.threads, 0);
  how.progress = options.progress;
  state->tree = fast::build_display_tree(display.scene(), how);
  if (state->tree.nodes.empty()) return detail::stopped();
  fast::divide_leaves(state->tree, display.scene());
  state->vertices = fast::fragment_vertices(display.scene(), state->tree);
  return CutDisplay(std::move(state));
}

Result<std::vector<SeenArea>> CutDisplay::seen_areas(const View& view) const {
  if (!view.clips.empty()) {
    return Error{ErrorCode::kOutOfRange,
                 "seen areas are not for clip planes; cut solids by "
                 "Solid::split()"};
  }
  const Display& display = *state_->display;
  const Result<Camera> camera = display.camera(view);
  if (!camera) return camera.error();
  const auto polygons = display.polygons_of_scene();
  const auto map =
      fast::visible_map(display.scene(), state_->tree, *camera,
                        {view.cull, {polygons.begin(), polygons.end()}});
  if (!map) return map.error();
  std::vector<SeenArea> areas;
  for (const fast::SeenArea& area : fast::seen_areas(*map, *camera))
    areas.push_back({area.key, area.area_px, area.solid_angle});
  return areas;
}

VertexFeed CutDisplay::vertex_feed() const {
  const Display& display = *state_->display;
  const double step = detail::step_of(display.scene().unit());
  const auto polygons = display.polygons_of_scene();
  VertexFeed feed;
  for (const auto& p : state_->vertices.positions)
    feed.positions.push_back({step * p[0], step * p[1], step * p[2]});
  for (const PolygonId polygon : state_->vertices.polygons)
    feed.polygons.push_back(polygons[static_cast<std::size_t>(polygon)]);
  return feed;
}

Result<std::vector<std::uint32_t>> CutDisplay::feed_indices(
    const View& view, FeedOrder order) const {
  const Display& display = *state_->display;
  const Result<Camera> camera = display.camera(view);
  if (!camera) return camera.error();
  return fast::order_indices(display.scene(), state_->tree, state_->vertices,
                             *camera, order);
}

}  // namespace halfspace
