#include "operands.hpp"

#include <utility>

#include "halfspace/io/mesh.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/scene_file.hpp"
#include "loading.hpp"

namespace halfspace::tools {
namespace {

io::Number number_of(std::int64_t steps, const Unit& unit) {
  return io::normalised(steps, unit.exponent,
                        unit.base == 10 ? unit.exponent : 0);
}

/// The scene as a mesh, exactly.
io::Mesh mesh_of(const Scene& scene) {
  io::Mesh mesh;
  const SceneData& data = scene.data();
  for (const GridPoint& v : data.vertices) {
    mesh.vertices.push_back({number_of(v.x, data.unit),
                             number_of(v.y, data.unit),
                             number_of(v.z, data.unit)});
  }
  mesh.first_corner = data.first_corner;
  mesh.corners = data.corners;
  mesh.face_colors.assign(data.colors.begin(), data.colors.end());
  mesh.decimal = data.unit.base == 10;
  return mesh;
}

Result<io::Mesh> mesh_in(const std::string& path) {
  if (is_scene_name(path)) {
    const Result<Loaded> loaded = load(path, {});
    if (!loaded) return loaded.error();
    return mesh_of(loaded->file.scene);
  }
  Result<io::Mesh> mesh = io::read_mesh(path);
  if (!mesh) return about(path, mesh.error());
  if (mesh->face_count() == 0) {
    return Error{ErrorCode::kEmpty, path + ": there are no polygons"};
  }
  return mesh;
}

/// Adds the vertices of `other`'s faces to `mesh`, each held by a face without
/// area: import drops those faces, but finds the grid that holds them too.
/// Returns how many there are.
std::size_t add_points(io::Mesh& mesh, const io::Mesh& other) {
  std::vector<bool> used(other.vertices.size());
  for (std::size_t face = 0; face < other.face_count(); ++face) {
    const std::size_t first = other.first_corner[face];
    const std::size_t last = other.first_corner[face + 1];
    if (last - first < 3) continue;
    for (std::size_t i = first; i < last; ++i)
      used[static_cast<std::size_t>(other.corners[i])] = true;
  }
  std::size_t count = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    const auto id = static_cast<VertexId>(mesh.vertices.size());
    mesh.vertices.push_back(other.vertices[v]);
    mesh.corners.insert(mesh.corners.end(), {id, id, id});
    mesh.first_corner.push_back(
        static_cast<std::uint32_t>(mesh.corners.size()));
    ++count;
  }
  if (!mesh.vertex_colors.empty())
    mesh.vertex_colors.resize(mesh.vertices.size());
  if (!mesh.face_colors.empty()) mesh.face_colors.resize(mesh.face_count());
  return count;
}

/// The solid of `mesh` on the grid that holds `other` too.
Result<Solid> solid_of(io::Mesh mesh, const io::Mesh& other,
                       const std::string& path, std::optional<int> grid_bits,
                       io::ImportReport& report) {
  mesh.decimal = mesh.decimal && other.decimal;
  const std::size_t added = add_points(mesh, other);
  Result<io::Imported> imported =
      io::import_scene(mesh, {.grid_bits = grid_bits});
  if (!imported) return about(path, imported.error());
  // Either import moves the points of both operands.
  report.moved = imported->report.moved;
  report.max_move = imported->report.max_move;
  report.unit = imported->report.unit;
  report.grid_bits = imported->report.grid_bits;
  report.triangulated += imported->report.triangulated;
  report.dropped += imported->report.dropped - added;
  Result<Solid> solid = make_solid(std::move(imported->scene));
  if (!solid) return about(path, solid.error());
  return solid;
}

}  // namespace

Result<Operands> load_operands(const std::string& path_a,
                               const std::string& path_b,
                               std::optional<int> grid_bits) {
  Result<io::Mesh> mesh_a = mesh_in(path_a);
  if (!mesh_a) return mesh_a.error();
  Result<io::Mesh> mesh_b = mesh_in(path_b);
  if (!mesh_b) return mesh_b.error();
  Operands operands;
  Result<Solid> a =
      solid_of(*mesh_a, *mesh_b, path_a, grid_bits, operands.report);
  if (!a) return a.error();
  Result<Solid> b =
      solid_of(*mesh_b, *mesh_a, path_b, grid_bits, operands.report);
  if (!b) return b.error();
  operands.report.vertices = mesh_a->vertices.size() + mesh_b->vertices.size();
  operands.report.polygons = mesh_a->face_count() + mesh_b->face_count();
  operands.a = *std::move(a);
  operands.b = *std::move(b);
  return operands;
}

}  // namespace halfspace::tools
