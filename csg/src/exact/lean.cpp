#include "lean.hpp"

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>

namespace halfspace::csg {
namespace {

/// The faces as a scene's polygons; nothing where one is no single loop of
/// points of the grid.
std::optional<SceneData> polygons_of_faces(const fast::Solid& solid,
                                           const Scene& scene) {
  SceneData data;
  data.unit = scene.unit();
  data.grid_bits = scene.grid_bits();
  data.first_corner = {0};
  std::unordered_map<std::int32_t, VertexId> numbers;
  numbers.reserve(scene.data().vertices.size());
  for (const fast::Face& face : solid.faces) {
    const fast::SolidEdge* edges = solid.edges.data() + face.first_edge;
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const std::uint32_t next = i + 1 < face.edge_count ? i + 1 : 0;
      if (edges[i].to != edges[next].from) return std::nullopt;
      const auto [at, is_new] = numbers.try_emplace(
          edges[i].from, static_cast<VertexId>(data.vertices.size()));
      if (is_new) {
        const fast::SolidVertex v = fast::vertex_at(solid, edges[i].from);
        if (!v.is_grid) return std::nullopt;
        data.vertices.push_back(v.point);
      }
      data.corners.push_back(at->second);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(face.color);
  }
  return data;
}

}  // namespace

LeanSurface lean_surface(fast::Solid solid, const Scene& scene) {
  const std::size_t faces = solid.faces.size(), edges = solid.edges.size();
  solid = fast::merge_faces(std::move(solid), fast::Merge::kColor);
  LeanSurface result;
  result.is_lean = solid.faces.size() == faces && solid.edges.size() == edges;
  if (result.is_lean) return result;
  std::optional<SceneData> data = polygons_of_faces(solid, scene);
  if (!data) return result;
  // That they are convex is looked at here.
  Result<Scene> merged = make_scene(*std::move(data));
  if (!merged) return result;
  Result<GridSolid> made = make_solid(*std::move(merged));
  if (!made) return result;
  result.solid = std::make_shared<const GridSolid>(*std::move(made));
  for (const fast::Face& face : solid.faces)
    result.polygons.push_back(face.polygon);
  return result;
}

}  // namespace halfspace::csg
