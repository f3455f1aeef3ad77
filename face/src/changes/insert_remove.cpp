#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "display_state.hpp"
#include "halfspace/display.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/fast/traverse.hpp"
#include "import.hpp"

/// Polygons that come to a display and leave it.
namespace halfspace {
namespace {

/// Whether the second scene begins with the first, in the same steps: then
/// vertices and polygons of the one are those of the other.
bool begins_with(const SceneData& before, const SceneData& after) {
  const auto is_first = [](const auto& all, const auto& part) {
    return part.size() <= all.size() &&
           std::equal(part.begin(), part.end(), all.begin());
  };
  return before.unit == after.unit && before.grid_bits == after.grid_bits &&
         is_first(after.vertices, before.vertices) &&
         is_first(after.corners, before.corners) &&
         is_first(after.first_corner, before.first_corner);
}

/// A tree of the scene `before` with the numbers of `after`, which begins with
/// it: free planes come after polygons, and cuts after vertices.
void renumber(fast::BspTree& tree, const Scene& before, const Scene& after) {
  const auto more_points = static_cast<std::int32_t>(
      after.data().vertices.size() - before.data().vertices.size());
  const auto points = static_cast<std::int32_t>(before.data().vertices.size());
  const auto polygons = static_cast<std::int32_t>(before.polygon_count());
  const auto more_polygons =
      static_cast<std::int32_t>(after.polygon_count()) - polygons;
  for (fast::Corner& corner : tree.corners) {
    if (corner.vertex >= points) corner.vertex += more_points;
    if (-1 - corner.edge >= polygons) corner.edge -= more_polygons;
  }
  for (fast::Node& node : tree.nodes) {
    if (node.splitter >= polygons) node.splitter += more_polygons;
  }
}

/// A tree of which polygons were removed, for a scene without them. Splitters
/// that are planes of theirs become free planes through the same points.
class Renamed {
 public:
  /// `now`: by polygon its number among those that are left, or -1.
  Renamed(fast::BspTree& tree, const Scene& scene,
          const std::vector<PolygonId>& now, std::int32_t left)
      : tree_(tree), scene_(scene), now_(now), left_(left) {
    if (tree.slanted) points_ = *tree.slanted;
    plane_of_.assign(now.size(), -1);
  }

  void rename() {
    for (fast::Node& node : tree_.nodes) {
      if (node.splitter != fast::kNoPlane) node.splitter = name(node.splitter);
    }
    for (fast::TreeFragment& fragment : tree_.fragments)
      fragment.source = now_[static_cast<std::size_t>(fragment.source)];
    for (fast::Corner& corner : tree_.corners) {
      if (corner.edge < 0) corner.edge = -1 - name(-1 - corner.edge);
    }
    tree_.slanted = std::make_shared<const std::vector<RegionFace>>(points_);
  }

 private:
  fast::PlaneId name(fast::PlaneId plane) {
    const auto polygons = static_cast<fast::PlaneId>(now_.size());
    if (plane >= polygons) return plane - polygons + left_;
    const auto p = static_cast<std::size_t>(plane);
    if (now_[p] >= 0) return now_[p];
    if (plane_of_[p] < 0) {
      plane_of_[p] =
          left_ + static_cast<fast::PlaneId>(tree_.free_planes.size());
      tree_.free_planes.push_back(
          {fast::kSlantedFace, static_cast<std::int64_t>(points_.size())});
      points_.push_back(fast::plane_corners(scene_, plane));
    }
    return plane_of_[p];
  }

  fast::BspTree& tree_;
  const Scene& scene_;
  const std::vector<PolygonId>& now_;
  std::int32_t left_;
  std::vector<RegionFace> points_;
  std::vector<fast::PlaneId> plane_of_;  ///< by polygon that is gone
};

/// The scene without some polygons. Vertices stay.
Result<Scene> scene_without(const Scene& scene, const std::vector<bool>& gone) {
  const SceneData& from = scene.data();
  SceneData to;
  to.unit = from.unit;
  to.grid_bits = from.grid_bits;
  to.vertices = from.vertices;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    if (gone[p]) continue;
    const auto id = static_cast<PolygonId>(p);
    const auto corners = scene.corners(id);
    to.corners.insert(to.corners.end(), corners.begin(), corners.end());
    to.first_corner.push_back(static_cast<std::uint32_t>(to.corners.size()));
    to.colors.push_back(scene.color(id));
    const auto colors = scene.corner_colors(id);
    to.corner_colors.insert(to.corner_colors.end(), colors.begin(),
                            colors.end());
  }
  return make_scene(std::move(to));
}

/// The mesh without some faces. Vertices stay.
void take_faces(io::Mesh& mesh, const std::vector<bool>& gone) {
  io::Mesh left;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (gone[f]) continue;
    for (auto i = mesh.first_corner[f]; i < mesh.first_corner[f + 1]; ++i)
      left.corners.push_back(mesh.corners[i]);
    left.first_corner.push_back(
        static_cast<std::uint32_t>(left.corners.size()));
    if (!mesh.face_colors.empty())
      left.face_colors.push_back(mesh.face_colors[f]);
  }
  mesh.corners = std::move(left.corners);
  mesh.first_corner = std::move(left.first_corner);
  mesh.face_colors = std::move(left.face_colors);
}

/// A tree that changes as often as it has polygons is made anew: so its depth
/// stays that of a tree that is built, and a change costs no more than a share
/// of the build.
bool is_worn(std::size_t changes, std::size_t built) { return changes > built; }

}  // namespace

Result<Done> Display::insert(const Mesh& mesh) {
  if (const auto fault = detail::fault_of(mesh)) return *fault;
  if (state_->mesh.face_count() == 0) {
    return Error{ErrorCode::kUnknownFormat,
                 "a display of a scene file takes no more polygons"};
  }
  const io::Mesh more = detail::exact_mesh(mesh);
  io::Mesh all = state_->mesh;
  all.decimal = all.decimal && more.decimal;
  detail::append(more, all);
  auto next = State::of(std::move(all));
  if (!next) return next.error();
  State& after = **next;
  after.continue_numbers(*state_);
  const std::size_t changes = state_->changes + after.scene.polygon_count() -
                              state_->scene.polygon_count();
  if (state_->ordered && !is_worn(changes, state_->built_count) &&
      begins_with(state_->scene.data(), after.scene.data())) {
    fast::BspTree tree = std::move(*state_->ordered);
    renumber(tree, state_->scene, after.scene);
    tree.boxes.clear();
    tree.triangles.clear();
    tree.quadrangles.clear();
    tree.first_blocks.clear();
    for (auto p = state_->scene.polygon_count();
         p < after.scene.polygon_count(); ++p)
      fast::insert(tree, after.scene, static_cast<PolygonId>(p));
    after.tree = tree;
    after.ordered = std::move(tree);
    after.built_count = state_->built_count;
    after.changes = changes;
  }
  state_ = *std::move(next);
  return Done{};
}

Result<Done> Display::remove(std::span<const std::int32_t> polygons) {
  State& state = *state_;
  const Lock lock(state.mutex);
  std::vector<bool> leaves(state.polygon_count);
  for (const std::int32_t polygon : polygons) {
    if (polygon < 0 || static_cast<std::size_t>(polygon) >= leaves.size()) {
      return Error{ErrorCode::kBadIndex,
                   "there is no polygon " + std::to_string(polygon), polygon};
    }
    leaves[static_cast<std::size_t>(polygon)] = true;
  }
  // Step 1: the scene and the mesh without them; the others keep their numbers.
  const std::size_t count = state.scene.polygon_count();
  std::vector<bool> gone(count);
  std::vector<PolygonId> ids;
  std::vector<PolygonId> now(count, -1);
  std::vector<std::int32_t> faces;
  for (std::size_t p = 0; p < count; ++p) {
    const std::int32_t number = state.faces[p];
    gone[p] = leaves[static_cast<std::size_t>(number)];
    if (gone[p]) ids.push_back(static_cast<PolygonId>(p));
    if (gone[p]) continue;
    now[p] = static_cast<PolygonId>(faces.size());
    faces.push_back(number);
  }
  if (ids.empty()) return Done{};
  if (faces.empty()) {
    return Error{ErrorCode::kEmpty,
                 "no polygon would be left; a display shows some"};
  }
  Result<Scene> left = scene_without(state.scene, gone);
  if (!left) return left.error();
  if (state.mesh.face_count() > 0) {
    std::vector<bool> face_gone(state.mesh.face_count());
    std::vector<std::int32_t> numbers;
    for (std::size_t f = 0; f < face_gone.size(); ++f) {
      const std::int32_t number = state.numbers.empty()
                                      ? static_cast<std::int32_t>(f)
                                      : state.numbers[f];
      face_gone[f] = leaves[static_cast<std::size_t>(number)];
      if (!face_gone[f]) numbers.push_back(number);
    }
    take_faces(state.mesh, face_gone);
    state.numbers = std::move(numbers);
  }
  // Step 2: the trees without them (S3.11).
  state.changes += ids.size();
  const bool worn = is_worn(state.changes, state.built_count);
  for (std::optional<fast::BspTree>* tree : {&state.tree, &state.ordered}) {
    if (worn) tree->reset();
    if (!*tree) continue;
    fast::remove(**tree, state.scene, ids);
    Renamed(**tree, state.scene, now, static_cast<std::int32_t>(faces.size()))
        .rename();
  }
  if (worn) {
    state.built_count = faces.size();
    state.changes = 0;
  }
  state.lazy.reset();
  state.scene = *std::move(left);
  state.faces = std::move(faces);
  state.closed.reset();
  state.solids.reset();
  return Done{};
}

}  // namespace halfspace
