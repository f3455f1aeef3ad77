#include "solid/move_to_table.hpp"

#include "base/id_map.hpp"
#include "halfspace/assert.hpp"

namespace halfspace::fast {

Solid moved_to(const Solid& solid, TableLease& lease) {
  Solid result = solid;
  result.table = lease.shared();
  if (solid.table == result.table) return result;
  HALFSPACE_ASSERT(solid.table || solid.faces.empty());
  if (solid.faces.empty()) return result;
  const GeometryTable& from = *solid.table;
  GeometryTable& to = lease.table();
  // Step 1: which planes and points there are.
  IdRange planes, vertices;
  for (const Face& face : solid.faces) planes.add(face.plane);
  for (const SolidEdge& edge : solid.edges) {
    if (edge.other >= 0) planes.add(edge.other);
    for (const std::int32_t v : {edge.from, edge.to}) {
      vertices.add(v);
      if (from.vertex(v).is_grid()) continue;
      for (const std::int32_t p : from.vertex(v).planes) planes.add(p);
    }
  }
  // Step 2: they are interned as they come up.
  Renumbering new_planes(planes), new_vertices(vertices);
  const auto plane = [&](std::int32_t p) {
    std::int32_t& id = new_planes.at(p);
    if (id < 0) id = to.add_plane(from.normal(p), from.plane(p).origin).plane;
    return id;
  };
  const auto vertex = [&](std::int32_t v) {
    std::int32_t& id = new_vertices.at(v);
    if (id < 0) {
      const TableVertex& old = from.vertex(v);
      id = old.is_grid() ? to.add_point(old.point())
                         : to.meet(plane(old.planes[0]), plane(old.planes[1]),
                                   plane(old.planes[2]));
    }
    return id;
  };
  for (Face& face : result.faces) face.plane = plane(face.plane);
  for (SolidEdge& edge : result.edges) {
    edge = {vertex(edge.from), vertex(edge.to),
            edge.other < 0 ? -1 : plane(edge.other)};
  }
  return result;
}

}  // namespace halfspace::fast
