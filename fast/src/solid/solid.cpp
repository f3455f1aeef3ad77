#include "halfspace/fast/solid.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/fast/predicate.hpp"
#include "solid/loops.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

/// Faces are made in blocks of this size, so that planes are looked up
/// together. Untuned.
constexpr std::size_t kFacesAtOnce = 64;

/// Holds the polygon as face_box() would: points of the grid have no error, and
/// rounding keeps their order.
Box polygon_box(const Scene& scene, std::span<const VertexId> corners) {
  const Vertex first = to_vertex(scene.point(corners[0]));
  std::array<double, 3> low = {first.x, first.y, first.z};
  std::array<double, 3> high = low;
  const auto add = [&](const GridPoint& point) {
    const Vertex v = to_vertex(point);
    low = {std::min(low[0], v.x), std::min(low[1], v.y), std::min(low[2], v.z)};
    high = {std::max(high[0], v.x), std::max(high[1], v.y),
            std::max(high[2], v.z)};
  };
  for (const VertexId corner : corners.subspan(1)) add(scene.point(corner));
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = rounded_down(low[k]);
    box.high[k] = rounded_up(high[k]);
  }
  return box;
}

/// The corners that define the polygon's plane. A triangle's are all: they are
/// copied right where they are wanted.
void set_plane_corners(const Scene& scene, PolygonId id,
                       std::array<GridPoint, 3>& corners) {
  const auto ids = scene.corners(id);
  if (ids.size() != 3) {
    corners = plane_corners(scene, id);
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) corners[i] = scene.point(ids[i]);
}

/// Adds the face that polygon `id` is. `ids`: the points of its vertices.
void add_face(const Scene& scene, PolygonId id, std::int32_t part,
              OrientedPlane plane, const std::vector<std::int32_t>& ids,
              Solid& solid) {
  const auto corners = scene.corners(id);
  // In its place: a copy would wait for what was just written.
  Face& face = solid.faces.emplace_back();
  face.plane = plane.plane;
  face.flipped = plane.flipped;
  face.color = scene.color(id);
  face.source = id;
  face.part = part;
  face.polygon = id;
  face.first_edge = static_cast<std::uint32_t>(solid.edges.size());
  face.edge_count = static_cast<std::uint32_t>(corners.size());
  face.box = polygon_box(scene, corners);
  std::int32_t from = ids[static_cast<std::size_t>(corners[0])];
  const std::int32_t first = from;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const std::int32_t to = ids[static_cast<std::size_t>(corners[i])];
    solid.edges.push_back({from, to});
    from = to;
  }
  solid.edges.push_back({from, first});
}

Solid in_table(const GridSolid& solid, TableLease lease, std::int32_t part) {
  const Scene& scene = solid.scene();
  Solid result;
  result.unit = scene.unit();
  result.table = lease.shared();
  GeometryTable& table = lease.table();
  table.reserve(scene.data().vertices.size(), scene.polygon_count());
  result.faces.reserve(scene.polygon_count());
  result.edges.reserve(scene.data().corners.size());
  std::vector<std::int32_t> ids;
  ids.reserve(scene.data().vertices.size());
  table.add_points(scene.data().vertices, ids);
  std::array<std::array<GridPoint, 3>, kFacesAtOnce> corners;
  std::vector<OrientedPlane> planes;
  for (std::size_t first = 0; first < scene.polygon_count();
       first += kFacesAtOnce) {
    const std::size_t last =
        std::min(first + kFacesAtOnce, scene.polygon_count());
    planes.clear();
    for (std::size_t p = first; p < last; ++p) {
      // The next polygons' points are fetched meanwhile.
      constexpr std::size_t kAhead = 48;
      if (scene.data().first_corner[p] + kAhead + 3 <=
          scene.data().corners.size()) {
        const VertexId* far =
            &scene.data().corners[scene.data().first_corner[p] + kAhead];
        for (std::size_t k = 0; k < 3; ++k)
          __builtin_prefetch(&scene.point(far[k]));
      }
      set_plane_corners(scene, static_cast<PolygonId>(p), corners[p - first]);
    }
    table.add_planes(std::span(corners).first(last - first), planes);
    for (std::size_t p = first; p < last; ++p) {
      add_face(scene, static_cast<PolygonId>(p), part, planes[p - first], ids,
               result);
    }
  }
  return result;
}

}  // namespace

Solid to_solid(const GridSolid& solid, std::int32_t part) {
  return in_table(solid, TableLease::of_new(solid.scene().grid_bits()), part);
}

Solid to_solid(const GridSolid& solid, const Solid& with, std::int32_t part) {
  HALFSPACE_ASSERT(solid.scene().grid_bits() <= grid_bits_of(with));
  return in_table(solid, lease_beside(with), part);
}

Solid complement(Solid solid) {
  for (Face& face : solid.faces) face.flipped = !face.flipped;
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
  TableLease lease = lease_beside(with);
  Solid result;
  result.unit = with.unit;
  result.table = lease.shared();
  const OrientedPlane plane = lease.table().add_plane(corners);
  result.faces.emplace_back();
  result.faces[0].plane = plane.plane;
  result.faces[0].flipped = plane.flipped;
  result.faces[0].box = face_box(result, result.faces[0]);
  return result;
}

SolidPlane plane_at(const Solid& solid, std::int32_t plane) {
  const Vector3<Int128> n = solid.table->reduced_normal(plane);
  return {{n.x, n.y, n.z}, solid.table->plane(plane).origin};
}

SolidVertex vertex_at(const Solid& solid, std::int32_t vertex) {
  const TableVertex& v = solid.table->vertex(vertex);
  return {v.is_grid(), v.is_grid() ? v.point() : GridPoint{}, v.planes};
}

}  // namespace halfspace::fast
