#include <string>
#include <unordered_map>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "rounding/grid_hash.hpp"
#include "rounding/mesh_polygons.hpp"
#include "rounding/settle.hpp"

namespace halfspace::fast {
namespace {

/// The scene in fans, equal points as one; each counts as moved, to where it
/// is.
LooseMesh loose_mesh_of(const Scene& scene) {
  LooseMesh result;
  std::unordered_map<GridPoint, std::int32_t, GridPointHash> ids;
  std::vector<std::int32_t> id_of;
  for (const GridPoint& p : scene.data().vertices) {
    const auto id = static_cast<std::int32_t>(result.mesh.points.size());
    const auto [at, is_new] = ids.try_emplace(p, id);
    id_of.push_back(at->second);
    if (!is_new) continue;
    result.mesh.points.push_back(p);
    // Doubles hold the points of all grids.
    result.loose.push_back({id,
                            {static_cast<double>(p.x), static_cast<double>(p.y),
                             static_cast<double>(p.z)}});
  }
  result.mesh.moved.resize(result.mesh.points.size());
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto polygon = static_cast<PolygonId>(p);
    const auto corners = scene.corners(polygon);
    const auto id = [&](std::size_t i) {
      return id_of[static_cast<std::size_t>(corners[i])];
    };
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      result.mesh.triangles.push_back({{id(0), id(i), id(i + 1)}, polygon});
  }
  return result;
}

std::string text_of(const GridPoint& p) {
  return std::to_string(p.x) + ", " + std::to_string(p.y) + ", " +
         std::to_string(p.z);
}

/// The mesh as a scene like the other one.
SettledScene scene_of(GridMesh& mesh, const Scene& like) {
  SettledScene result;
  SceneData data;
  data.unit = like.unit();
  data.grid_bits = like.data().grid_bits;
  drop_unused_points(mesh);
  for (const MeshPolygon& polygon : polygons_of(mesh)) {
    data.corners.insert(data.corners.end(), polygon.corners.begin(),
                        polygon.corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(
        like.data().colors[static_cast<std::size_t>(polygon.source)]);
    result.polygons.push_back(polygon.source);
  }
  data.vertices = std::move(mesh.points);
  Result<Scene> scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  result.scene = *std::move(scene);
  return result;
}

}  // namespace

Result<SettledScene> settled_scene(const Scene& scene, int threads) {
  const FileGrid grid = FileGrid::of_bits(scene.data().grid_bits);
  Settled settled = settle(loose_mesh_of(scene), grid, threads);
  if (settled.end != Settling::kDone) {
    return Error{ErrorCode::kOutOfRange,
                 "no rounding of the surface was found that does not cross "
                 "itself; it still does near grid point " +
                     text_of(settled.contact)};
  }
  SettledScene result = scene_of(settled.mesh, scene);
  result.max_move = settled.max_move;
  result.contacts = settled.first_contacts;
  return result;
}

}  // namespace halfspace::fast
