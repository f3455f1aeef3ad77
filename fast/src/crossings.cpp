#include "halfspace/fast/crossings.hpp"

#include <algorithm>
#include <tuple>

#include "boolean_contact.hpp"
#include "self_contacts.hpp"

namespace halfspace::fast {
namespace {

/// Where faces in one plane begin to overlap: an edge of one with both of them
/// on the same side of it.
void add_overlaps(const Operand& a, std::vector<Crossing>& found) {
  for (const Cover& cover : a.covers) {
    const LineEdge& edge = a.edges[static_cast<std::size_t>(cover.edge)];
    const Face& other = a.face(cover.face);
    for (std::uint32_t u = 0; u < edge.use_count; ++u) {
      const EdgeUse& use = a.uses[edge.first_use + u];
      const Face& face = a.face(use.face);
      const bool left = use.forward != face.turned;
      if (use.face == cover.face || face.plane != other.plane ||
          !(left ? cover.left : cover.right))
        continue;
      found.push_back({std::min(use.face, cover.face),
                       std::max(use.face, cover.face), cover.low, true});
    }
  }
}

}  // namespace

SelfContacts self_contacts(const Solid& solid) {
  SelfContacts result;
  Operand& a = result.operand;
  Operand b;
  a.solid = b.solid = &solid;
  prepare(a, b, *solid.space);
  const auto pairs = near_pairs(a, b);
  add_edges(a, *solid.space);
  add_edges(b, *solid.space);
  Contact contact(a, b, *solid.space, result.traces);
  for (const auto& [f, g] : pairs) {
    if (f != g) contact.meet(f, g);
  }
  return result;
}

std::vector<Crossing> crossings_of(const SelfContacts& contacts) {
  std::vector<Crossing> found;
  for (const Trace& trace : contacts.traces) {
    if (trace.first < trace.second)
      found.push_back({trace.first, trace.second, trace.low, false});
  }
  add_overlaps(contacts.operand, found);
  const auto key = [](const Crossing& c) {
    return std::tuple(c.first, c.second, c.in_plane);
  };
  std::stable_sort(
      found.begin(), found.end(),
      [&](const Crossing& c, const Crossing& d) { return key(c) < key(d); });
  found.erase(std::unique(found.begin(), found.end(),
                          [](const Crossing& c, const Crossing& d) {
                            return c.first == d.first && c.second == d.second;
                          }),
              found.end());
  return found;
}

std::vector<Crossing> crossings(const Solid& solid) {
  return crossings_of(self_contacts(solid));
}

}  // namespace halfspace::fast
