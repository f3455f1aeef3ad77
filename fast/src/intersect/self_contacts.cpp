#include "intersect/self_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "intersect/candidates.hpp"
#include "intersect/face_intersection.hpp"

namespace halfspace::fast {

std::array<double, 3> place_of(const Solid& solid, std::int32_t vertex) {
  const Vertex& at = solid.table->vertex(vertex).approximate;
  const double step = std::pow(static_cast<double>(solid.unit.base),
                               static_cast<double>(solid.unit.exponent));
  return {step * at.x, step * at.y, step * at.z};
}

namespace {

/// Both copies of the operand, with the edges of the active faces.
void begin(const Solid& solid, TableLease& lease, Operand& a, Operand& b) {
  a.solid = b.solid = &solid;
  a.blocks = b.blocks = std::make_shared<const EdgePackets>(solid);
  prepare(a, b, lease.scratch<BooleanScratch>());
}

void find_contacts(Operand& a, Operand& b,
                   std::span<const FacePairs::value_type> pairs,
                   TableLease& lease, SelfContacts& result) {
  add_edges(a, lease.table());
  add_edges(b, lease.table());
  FaceIntersector contact(a, b, lease.table(), result.segments);
  for (const auto& [f, g] : pairs) {
    if (f != g) contact.meet(f, g);
  }
}

}  // namespace

SelfContacts self_contacts(const Solid& solid, TableLease& lease) {
  SelfContacts result;
  Operand b;
  begin(solid, lease, result.operand, b);
  const auto pairs = candidate_pairs(result.operand, b);
  find_contacts(result.operand, b, pairs, lease, result);
  return result;
}

SelfContacts self_contacts(const Solid& solid, TableLease& lease,
                           const SurfaceEdges& edges, const FacePairs& pairs,
                           std::span<const std::int32_t> more) {
  SelfContacts result;
  Operand& a = result.operand;
  Operand b;
  begin(solid, lease, a, b);
  // Step 1: the faces, those at edges that not two faces have, and all that
  // have an edge of any of them.
  const auto activate = [&](std::int32_t f) {
    a.is_active[static_cast<std::size_t>(f)] = 1;
  };
  for (const auto& [f, g] : pairs) {
    activate(f);
    activate(g);
  }
  for (const std::int32_t f : more) activate(f);
  const auto for_edges = [&](std::size_t f, auto&& visit) {
    const Face& face = solid.faces[f];
    for (std::uint32_t i = 0; i < face.edge_count; ++i)
      visit(edges.neighbour(face.first_edge + i));
  };
  std::vector<std::int32_t> beside;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    for_edges(f, [&](std::int32_t neighbour) {
      if (neighbour < 0)
        activate(static_cast<std::int32_t>(f));
      else if (a.is_active[f] != 0)
        beside.push_back(neighbour);
    });
  }
  for (const std::int32_t f : beside) activate(f);
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    if (a.is_active[f] != 0) a.active.push_back(static_cast<std::int32_t>(f));
  }
  b.active = a.active;
  b.is_active = a.is_active;
  // Step 2: each pair twice, as each face may be the first operand's.
  FacePairs both = pairs;
  for (const auto& [f, g] : pairs) both.emplace_back(g, f);
  std::sort(both.begin(), both.end());
  find_contacts(a, b, both, lease, result);
  return result;
}

}  // namespace halfspace::fast
