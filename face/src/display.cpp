#include "halfspace/display.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "display_state.hpp"
#include "halfspace/csg/exact.hpp"
#include "halfspace/fast/display_tree.hpp"
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

/// Adds the polygons of one mesh to another.
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

}  // namespace

Result<std::unique_ptr<Display::State>> Display::State::of(io::Mesh mesh) {
  auto state = std::make_unique<State>();
  io::ImportOptions options;
  options.refine_bits = kRefineBits;
  Result<io::Imported> imported = io::import_scene(mesh, options);
  if (!imported) return imported.error();
  if (imported->scene.polygon_count() == 0) {
    return Error{ErrorCode::kEmpty, "there are no polygons to look at"};
  }
  state->polygon_count = mesh.face_count();
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
  auto state = State::of(exact_mesh(mesh));
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
    const io::Mesh exact = exact_mesh(*mesh);
    all.decimal = exact.decimal && (starts.empty() || all.decimal);
    starts.push_back(static_cast<std::int32_t>(all.face_count()));
    append(exact, all);
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
  const io::Mesh more = exact_mesh(mesh);
  io::Mesh all = state_->mesh;
  all.decimal = all.decimal && more.decimal;
  append(more, all);
  auto next = State::of(std::move(all));
  if (!next) return next.error();
  (*next)->solid_starts = state_->solid_starts;
  const Scene& before = state_->scene;
  const Scene& after = (*next)->scene;
  // The polygons that were there are the first ones, in the same steps.
  if (state_->ordered && before.unit() == after.unit() &&
      before.grid_bits() == after.grid_bits()) {
    fast::BspTree tree = std::move(*state_->ordered);
    // Vertices are numbered anew, for cuts come after those of the scene.
    const auto more_points = static_cast<std::int32_t>(
        after.data().vertices.size() - before.data().vertices.size());
    const auto points =
        static_cast<std::int32_t>(before.data().vertices.size());
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
    tree.boxes.clear();
    tree.triangles.clear();
    tree.quadrangles.clear();
    tree.first_blocks.clear();
    for (std::int32_t p = 0; p < more_polygons; ++p)
      fast::insert(tree, after, polygons + p);
    (*next)->tree = tree;
    (*next)->ordered = std::move(tree);
  }
  state_ = *std::move(next);
  return Done{};
}

}  // namespace halfspace
