#include "halfspace/fast/solid.hpp"

#include <algorithm>

#include "boolean_result.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/predicate.hpp"
#include "space.hpp"

namespace halfspace::fast {
namespace {

/// The planes of all polygons.
std::vector<OrientedPlane> planes_of(const Scene& scene, Space& space) {
  std::vector<std::array<GridPoint, 3>> corners;
  corners.reserve(scene.polygon_count());
  for (std::size_t p = 0; p < scene.polygon_count(); ++p)
    corners.push_back(plane_corners(scene, static_cast<PolygonId>(p)));
  std::vector<OrientedPlane> planes;
  planes.reserve(corners.size());
  space.add_planes(corners, planes);
  return planes;
}

Solid in_space(const halfspace::Solid& solid, std::shared_ptr<Space> space,
               std::int32_t part) {
  const Scene& scene = solid.scene();
  Solid result;
  result.unit = scene.unit();
  result.space = std::move(space);
  result.space->reserve(scene.data().vertices.size(), scene.polygon_count());
  result.faces.reserve(scene.polygon_count());
  result.edges.reserve(scene.data().corners.size());
  std::vector<std::int32_t> ids;
  ids.reserve(scene.data().vertices.size());
  for (const GridPoint& point : scene.data().vertices)
    ids.push_back(result.space->add_point(point));
  const std::vector<OrientedPlane> planes = planes_of(scene, *result.space);
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const auto corners = scene.corners(id);
    const OrientedPlane plane = planes[p];
    Face face;
    face.plane = plane.plane;
    face.turned = plane.turned;
    face.color = scene.color(id);
    face.source = id;
    face.part = part;
    face.polygon = id;
    face.first_edge = static_cast<std::uint32_t>(result.edges.size());
    face.edge_count = static_cast<std::uint32_t>(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto at = [&](std::size_t k) {
        return ids[static_cast<std::size_t>(corners[k])];
      };
      result.edges.push_back({at(i), at(i + 1 < corners.size() ? i + 1 : 0)});
    }
    face.box = face_box(result, face);
    result.faces.push_back(face);
  }
  return result;
}

}  // namespace

Solid to_solid(const halfspace::Solid& solid, std::int32_t part) {
  return in_space(solid, std::make_shared<Space>(solid.scene().grid_bits()),
                  part);
}

Solid to_solid(const halfspace::Solid& solid, const Solid& with,
               std::int32_t part) {
  HALFSPACE_ASSERT(solid.scene().grid_bits() <= with.space->grid_bits());
  return in_space(solid, with.space, part);
}

Solid complement(Solid solid) {
  for (Face& face : solid.faces) face.turned = !face.turned;
  for (SolidEdge& edge : solid.edges) std::swap(edge.from, edge.to);
  // The edges of a loop stand in a row.
  for (const Face& face : solid.faces) {
    const auto first =
        solid.edges.begin() + static_cast<std::ptrdiff_t>(face.first_edge);
    std::reverse(first, first + static_cast<std::ptrdiff_t>(face.edge_count));
  }
  solid.unbounded = !solid.unbounded;
  return solid;
}

Solid half_space(const std::array<GridPoint, 3>& corners, const Solid& with) {
  Solid result;
  result.unit = with.unit;
  result.space = with.space;
  const OrientedPlane plane = result.space->add_plane(corners);
  result.faces.emplace_back();
  result.faces[0].plane = plane.plane;
  result.faces[0].turned = plane.turned;
  result.faces[0].box = face_box(result, result.faces[0]);
  return result;
}

SolidPlane plane_at(const Solid& solid, std::int32_t plane) {
  const SpacePlane& p = solid.space->plane(plane);
  return {{p.normal.x, p.normal.y, p.normal.z}, p.origin};
}

SolidVertex vertex_at(const Solid& solid, std::int32_t vertex) {
  const SpaceVertex& v = solid.space->vertex(vertex);
  return {v.is_grid(), v.point, v.planes};
}

}  // namespace halfspace::fast
