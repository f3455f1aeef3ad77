#include "rounding/resolve_mesh.hpp"

#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "rounding/flip_thin.hpp"

namespace halfspace::fast {
namespace {

/// The surface as a solid: face `t` is triangle `t`.
Solid solid_of(GridMesh& mesh) {
  drop_unused_points(mesh);
  SceneData data;
  data.unit = {2, 0};
  data.grid_bits = grid_bits_for(mesh.points);
  data.vertices = std::move(mesh.points);
  data.corners.reserve(3 * mesh.triangles.size());
  data.first_corner.reserve(mesh.triangles.size() + 1);
  for (const GridTriangle& t : mesh.triangles) {
    data.corners.insert(data.corners.end(), t.corners.begin(), t.corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
  }
  data.colors.resize(mesh.triangles.size());
  Result<Scene> scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  const Result<GridSolid> solid = make_solid(*std::move(scene));
  HALFSPACE_ASSERT(solid.has_value());
  return to_solid(*solid);
}

}  // namespace

std::vector<LoosePoint> resolve_mesh(GridMesh& mesh, const FileGrid& grid,
                                     int threads) {
  std::vector<LoosePoint> loose;
  if (mesh.triangles.empty()) return loose;
  const Solid solid = resolve(solid_of(mesh)).solid;
  const ExportedMesh triangles =
      to_mesh(solid, {.triangles = true, .threads = threads});
  GridMesh result;
  result.points.resize(triangles.vertices.size());
  result.moved.resize(triangles.vertices.size());
  for (std::size_t v = 0; v < triangles.vertices.size(); ++v) {
    const SolidVertex vertex = vertex_at(solid, triangles.points[v]);
    result.points[v] = vertex.point;
    if (vertex.is_grid && grid.holds(vertex.point)) continue;
    loose.push_back({static_cast<std::int32_t>(v), triangles.vertices[v]});
  }
  result.triangles.reserve(triangles.faces.size());
  for (std::size_t t = 0; t < triangles.faces.size(); ++t) {
    const auto f = static_cast<std::size_t>(triangles.faces[t]);
    const auto source = static_cast<std::size_t>(solid.faces[f].polygon);
    const VertexId* c = &triangles.corners[3 * t];
    result.triangles.push_back(
        {{c[0], c[1], c[2]}, mesh.triangles[source].source});
  }
  mesh = std::move(result);
  flip_thin(mesh, loose, triangles.faces, grid.safe_height());
  return loose;
}

}  // namespace halfspace::fast
