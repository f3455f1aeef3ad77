#include "intersect/transversal_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "halfspace/assert.hpp"

namespace halfspace::fast {
namespace {

/// The plane through two points of the grid along the axis that is the farthest
/// from `plane`, which holds them.
std::int32_t plane_along_axis(std::int32_t u, std::int32_t v,
                              std::int32_t plane, GeometryTable& table) {
  const Plane& n = table.plane(plane).filter.plane;
  const std::array<double, 3> size{std::abs(n.a), std::abs(n.b), std::abs(n.c)};
  const auto axis = std::max_element(size.begin(), size.end()) - size.begin();
  const std::int32_t other = table.add_line_plane(u, v, static_cast<int>(axis));
  // What must hold: it meets the face's plane along the edge and is another.
  HALFSPACE_ASSERT(table.side(other, u) == 0 && table.side(other, v) == 0);
  HALFSPACE_ASSERT(other != plane);
  return other;
}

}  // namespace

std::int32_t transversal_plane(OperandEdge& edge, GeometryTable& table) {
  if (edge.other < 0)
    edge.other = plane_along_axis(edge.low, edge.high, edge.plane, table);
  return edge.other;
}

std::int32_t transversal_plane(const SolidEdge& edge, const Face& face,
                               GeometryTable& table) {
  return edge.other >= 0
             ? edge.other
             : plane_along_axis(edge.from, edge.to, face.plane, table);
}

}  // namespace halfspace::fast
