#include "intersect/self_contacts.hpp"

#include <cmath>

#include "intersect/candidates.hpp"
#include "intersect/face_intersection.hpp"

namespace halfspace::fast {

std::array<double, 3> place_of(const Solid& solid, std::int32_t vertex) {
  const Vertex& at = solid.table->vertex(vertex).approximate;
  const double step = std::pow(static_cast<double>(solid.unit.base),
                               static_cast<double>(solid.unit.exponent));
  return {step * at.x, step * at.y, step * at.z};
}

SelfContacts self_contacts(const Solid& solid, TableLease& lease) {
  SelfContacts result;
  Operand& a = result.operand;
  Operand b;
  a.solid = b.solid = &solid;
  prepare(a, b, lease.scratch<BooleanScratch>());
  const auto pairs = candidate_pairs(a, b);
  add_edges(a, lease.table());
  add_edges(b, lease.table());
  FaceIntersector contact(a, b, lease.table(), result.segments);
  for (const auto& [f, g] : pairs) {
    if (f != g) contact.meet(f, g);
  }
  return result;
}

}  // namespace halfspace::fast
