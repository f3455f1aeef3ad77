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
#include "halfspace/io/import.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "import.hpp"
#include "number.hpp"

namespace halfspace {
namespace {

/// A camera's lattice is 2^8 times finer than the grid (S4.1), so small
/// integers need a finer grid for a smooth choice of eyes: of 20 bits an eye
/// moves by less than a millionth of the scene.
constexpr int kRefineBits = 20;

/// Leaves the mesh no colours but those of its faces: faces come and go, and
/// what a file says of materials, vertices and corners is not kept up.
void keep_colors(const io::Imported& imported, io::Mesh& mesh) {
  mesh.vertex_colors.clear();
  mesh.attributes = {};
  if (imported.has_color.empty()) return;
  mesh.face_colors.resize(mesh.face_count());
  for (std::size_t p = 0; p < imported.faces.size(); ++p) {
    const auto face = static_cast<std::size_t>(imported.faces[p]);
    if (imported.has_color[face])
      mesh.face_colors[face] = imported.scene.color(static_cast<PolygonId>(p));
  }
}

/// The scene with the mesh's vertices for its own, at which polygons move.
Result<Scene> by_vertex(const io::Imported& imported, std::size_t count) {
  SceneData data = imported.scene.data();
  // Those that no polygon has are where some other is.
  std::vector<GridPoint> points(count, data.vertices.front());
  for (std::size_t i = 0; i < data.corners.size(); ++i) {
    points[static_cast<std::size_t>(imported.corner_vertices[i])] =
        data.vertices[static_cast<std::size_t>(data.corners[i])];
  }
  data.vertices = std::move(points);
  data.corners = imported.corner_vertices;
  return make_scene(std::move(data));
}

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

Result<std::unique_ptr<Display::State>> Display::State::of(
    io::Mesh mesh, const io::ImportOptions& options) {
  auto state = std::make_unique<State>();
  Result<io::Imported> imported = io::import_scene(mesh, options);
  if (!imported) return imported.error();
  if (imported->scene.polygon_count() == 0) {
    return Error{ErrorCode::kEmpty, "there are no polygons to look at"};
  }
  keep_colors(*imported, mesh);
  state->polygon_count = mesh.face_count();
  state->built_count = imported->scene.polygon_count();
  if (options.keep_vertices) {
    Result<Scene> scene = by_vertex(*imported, mesh.vertices.size());
    if (!scene) return scene.error();
    imported->scene = *std::move(scene);
    state->is_by_vertex = true;
  }
  state->mesh = std::move(mesh);
  state->scene = std::move(imported->scene);
  state->faces = std::move(imported->faces);
  return state;
}

void Display::State::continue_numbers(const State& before) {
  solid_starts = before.solid_starts;
  const std::size_t added = mesh.face_count() - before.mesh.face_count();
  polygon_count = before.polygon_count + added;
  if (polygon_count == mesh.face_count()) return;
  numbers = before.numbers;
  for (std::size_t p = before.polygon_count; p < polygon_count; ++p)
    numbers.push_back(static_cast<std::int32_t>(p));
  for (std::int32_t& face : faces)
    face = numbers[static_cast<std::size_t>(face)];
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

const fast::LazyTree* Display::State::opened_tree(int threads) {
  const Lock lock(mutex);
  if (tree) return nullptr;
  if (!lazy) {
    fast::LazyTreeOptions options;
    options.tree.threads = std::max(threads, 0);
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

}  // namespace halfspace
