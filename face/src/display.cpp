#include "halfspace/display.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "display_state.hpp"
#include "halfspace/csg/exact.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "import.hpp"
#include "node.hpp"
#include "number.hpp"

namespace halfspace {
namespace {

/// A camera's lattice is 2^8 times finer than the grid (S4.1), so small
/// integers need a finer grid for a smooth choice of eyes: of 20 bits an eye
/// moves by less than a millionth of the scene.
constexpr int kRefineBits = 20;

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

namespace detail {

io::ImportOptions import_options() {
  io::ImportOptions options;
  options.refine_bits = kRefineBits;
  return options;
}

io::Mesh exact_mesh(const Mesh& mesh) {
  detail::ExactPoints exact = detail::exact_points(mesh.vertices);
  io::Mesh result;
  result.vertices = std::move(exact.points);
  result.decimal = exact.decimal;
  result.first_corner = mesh.first_corner;
  result.corners = mesh.corners;
  result.face_colors.assign(mesh.colors.begin(), mesh.colors.end());
  return result;
}

void append(const io::Mesh& from, io::Mesh& to) {
  const auto first = static_cast<VertexId>(to.vertices.size());
  to.face_colors.resize(to.face_count());
  to.vertex_colors.clear();
  to.vertices.insert(to.vertices.end(), from.vertices.begin(),
                     from.vertices.end());
  for (std::size_t p = 0; p < from.face_count(); ++p) {
    for (std::size_t i = from.first_corner[p]; i < from.first_corner[p + 1];
         ++i)
      to.corners.push_back(first + from.corners[i]);
    to.first_corner.push_back(static_cast<std::uint32_t>(to.corners.size()));
    to.face_colors.push_back(from.face_colors.empty() ? std::nullopt
                                                      : from.face_colors[p]);
  }
}

}  // namespace detail

Result<std::unique_ptr<Display::State>> Display::State::of(io::Mesh mesh) {
  auto state = std::make_unique<State>();
  Result<io::Imported> imported =
      io::import_scene(mesh, detail::import_options());
  if (!imported) return imported.error();
  if (imported->scene.polygon_count() == 0) {
    return Error{ErrorCode::kEmpty, "there are no polygons to look at"};
  }
  state->polygon_count = mesh.face_count();
  state->built_count = imported->scene.polygon_count();
  state->mesh = std::move(mesh);
  state->scene = std::move(imported->scene);
  state->faces = std::move(imported->faces);
  return state;
}

const fast::BspTree* Display::State::picture_tree(const View& view) {
  const Lock lock(mutex);
  if (tree) return &*tree;
  fast::DisplayTreeOptions options;
  options.threads = std::max(view.threads, 0);
  options.progress = view.progress;
  fast::BspTree made = fast::build_display_tree(scene, options);
  if (made.nodes.empty()) return nullptr;
  tree = std::move(made);
  return &*tree;
}

const fast::LazyTree* Display::State::lazy_tree(const View& view) {
  if (!view.lazy || view.anti_aliasing == AntiAliasing::kExactArea)
    return nullptr;
  const Lock lock(mutex);
  if (tree) return nullptr;
  if (!lazy) {
    fast::LazyTreeOptions options;
    options.tree.threads = std::max(view.threads, 0);
    lazy.emplace(scene, options);
  }
  return &*lazy;
}

const fast::BspTree* Display::State::ordered_tree(const View& view) {
  const fast::BspTree* made = picture_tree(view);
  if (made == nullptr) return nullptr;
  const Lock lock(mutex);
  if (!ordered) {
    ordered = *made;
    fast::divide_leaves(*ordered, scene);
  }
  return &*ordered;
}

std::int32_t Display::State::polygon_of(PolygonId id) const {
  const auto index = static_cast<std::size_t>(id);
  if (index < faces.size()) return faces[index];
  return static_cast<std::int32_t>(polygon_count + index - faces.size());
}

std::int32_t Display::State::solid_of(std::int32_t polygon) const {
  const auto next =
      std::upper_bound(solid_starts.begin(), solid_starts.end(), polygon);
  return static_cast<std::int32_t>(next - solid_starts.begin()) - 1;
}

Display::Display(std::unique_ptr<State> state) : state_(std::move(state)) {}
Display::Display(Display&&) noexcept = default;
Display& Display::operator=(Display&&) noexcept = default;
Display::~Display() = default;

Result<Display> Display::of(Mesh mesh) {
  if (const auto fault = detail::fault_of(mesh)) return *fault;
  auto state = State::of(detail::exact_mesh(mesh));
  if (!state) return state.error();
  return Display(*std::move(state));
}

Result<Display> Display::of(const Solid& solid) {
  return of(std::span(&solid, 1));
}

Result<Display> Display::of(std::span<const Solid> solids) {
  io::Mesh all;
  std::vector<std::int32_t> starts;
  for (const Solid& solid : solids) {
    const Result<Mesh> mesh = solid.mesh();
    if (!mesh) return mesh.error();
    const io::Mesh exact = detail::exact_mesh(*mesh);
    all.decimal = exact.decimal && (starts.empty() || all.decimal);
    starts.push_back(static_cast<std::int32_t>(all.face_count()));
    detail::append(exact, all);
  }
  auto state = State::of(std::move(all));
  if (!state) return state.error();
  (*state)->solid_starts = std::move(starts);
  return Display(*std::move(state));
}

Result<Display> Display::of_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (!io::is_scene_name(path) && !io::is_solid_name(path)) {
    Result<io::Mesh> mesh = io::read_mesh(path);
    if (!mesh) return mesh.error();
    auto state = State::of(*std::move(mesh));
    if (!state) return io::error_about(name, state.error());
    return Display(*std::move(state));
  }
  Result<io::LoadedScene> loaded = csg::load_scene(name, {});
  if (!loaded) return loaded.error();
  auto state = std::make_unique<State>();
  state->scene = std::move(loaded->file.scene);
  state->faces = std::move(loaded->polygons);
  state->polygon_count = state->scene.polygon_count();
  state->built_count = state->polygon_count;
  return Display(std::move(state));
}

std::size_t Display::polygon_count() const { return state_->polygon_count; }

const Scene& Display::scene() const { return state_->scene; }

std::span<const std::int32_t> Display::polygons_of_scene() const {
  return state_->faces;
}

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
  after.solid_starts = state_->solid_starts;
  after.polygon_count = state_->polygon_count + more.face_count();
  if (after.polygon_count != after.mesh.face_count()) {
    // Some are gone: the others keep their numbers.
    after.numbers = state_->numbers;
    for (std::size_t p = state_->polygon_count; p < after.polygon_count; ++p)
      after.numbers.push_back(static_cast<std::int32_t>(p));
    for (std::int32_t& face : after.faces)
      face = after.numbers[static_cast<std::size_t>(face)];
  }
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
  return Done{};
}

}  // namespace halfspace
