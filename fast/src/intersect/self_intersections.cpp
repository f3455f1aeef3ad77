#include "halfspace/fast/self_intersections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "intersect/face_intersection.hpp"
#include "intersect/radial_order.hpp"
#include "intersect/self_contacts.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

/// Where faces in one plane begin to overlap: an edge of one with both of them
/// on the same side of it.
void add_overlaps(const Operand& a, std::vector<SelfIntersection>& found) {
  for (const Cover& cover : a.covers) {
    const LineEdge& edge = a.edges[static_cast<std::size_t>(cover.edge)];
    const Face& other = a.face(cover.face);
    for (std::uint32_t u = 0; u < edge.use_count; ++u) {
      const EdgeUse& use = a.uses[edge.first_use + u];
      const Face& face = a.face(use.face);
      const bool left = use.forward != face.flipped;
      if (use.face == cover.face || face.plane != other.plane ||
          !(left ? cover.left : cover.right))
        continue;
      found.push_back({std::min(use.face, cover.face),
                       std::max(use.face, cover.face),
                       place_of(*a.solid, cover.low), true});
    }
  }
}

/// Finds where a surface passes through itself along its edges (S6.6): where
/// the faces around a part of an edge, in radial order, do not leave and enter
/// the solid by turns.
///
/// The faces around a part of an edge are those that have the edge, and those
/// that cover this part of it. Between the ends of covers they are the same all
/// along.
class Passages {
 public:
  Passages(const Operand& operand, const GeometryTable& table)
      : operand_(operand), table_(table), covers_(operand.covers) {
    std::sort(covers_.begin(), covers_.end(),
              [](const Cover& c, const Cover& d) { return c.edge < d.edge; });
  }

  void add_to(std::vector<SelfIntersection>& found) {
    auto cover = covers_.begin();
    for (std::size_t e = 0; e < operand_.edges.size(); ++e) {
      const auto first = cover;
      while (cover != covers_.end() &&
             static_cast<std::size_t>(cover->edge) == e)
        ++cover;
      const LineEdge& edge = operand_.edges[e];
      others_.assign(first, cover);
      std::erase_if(others_,
                    [&](const Cover& c) { return is_of(c.face, edge); });
      if (edge.use_count > 2 || !others_.empty()) add_edge(edge, found);
    }
  }

 private:
  bool is_of(std::int32_t face, const LineEdge& edge) const {
    const auto first = operand_.uses.begin() + edge.first_use;
    return std::any_of(first, first + edge.use_count,
                       [&](const EdgeUse& use) { return use.face == face; });
  }
  bool is_before(int axis, std::int32_t u, std::int32_t v) const {
    return u != v && table_.compare(axis, u, v) < 0;
  }

  void add_edge(const LineEdge& edge, std::vector<SelfIntersection>& found);
  void add_wing(std::int32_t face, int turn) {
    const Face& of = operand_.face(face);
    wings_.push_back({0, face, of.plane, turn, of.flipped});
  }

  const Operand& operand_;
  const GeometryTable& table_;
  std::vector<Cover> covers_;       ///< by edge
  std::vector<Cover> others_;       ///< of the edge at hand, by other faces
  std::vector<std::int32_t> ends_;  ///< of its parts
  std::vector<Wing> wings_;
};

void Passages::add_edge(const LineEdge& edge,
                        std::vector<SelfIntersection>& found) {
  const int axis = edge.axis;
  ends_ = {edge.low, edge.high};
  for (const Cover& cover : others_)
    ends_.insert(ends_.end(), {cover.low, cover.high});
  std::sort(ends_.begin(), ends_.end(), [&](std::int32_t u, std::int32_t v) {
    return is_before(axis, u, v);
  });
  ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
  for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
    wings_.clear();
    for (std::uint32_t u = 0; u < edge.use_count; ++u) {
      const EdgeUse& use = operand_.uses[edge.first_use + u];
      add_wing(use.face,
               use.forward != operand_.face(use.face).flipped ? 1 : -1);
    }
    for (const Cover& cover : others_) {
      if (is_before(axis, ends_[i], cover.low) ||
          is_before(axis, cover.high, ends_[i + 1]))
        continue;
      if (cover.left) add_wing(cover.face, 1);
      if (cover.right) add_wing(cover.face, -1);
    }
    int sum = 0;
    for (const Wing& wing : wings_) sum += change(wing);
    // At a boundary of an open surface there is nothing to alternate.
    if (wings_.size() <= 2 || sum != 0) continue;
    sort_wings(wings_, axis, table_);
    for (std::size_t w = 0; w < wings_.size(); ++w) {
      const Wing& last = wings_[w == 0 ? wings_.size() - 1 : w - 1];
      const Wing& wing = wings_[w];
      if (wing.face == last.face || change(wing) != change(last)) continue;
      const bool same = wing.plane == last.plane && wing.turn == last.turn;
      found.push_back({std::min(wing.face, last.face),
                       std::max(wing.face, last.face),
                       place_of(*operand_.solid, ends_[i]), same});
    }
  }
}

}  // namespace

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
  const auto pairs = near_pairs(a, b);
  add_edges(a, lease.table());
  add_edges(b, lease.table());
  Contact contact(a, b, lease.table(), result.traces);
  for (const auto& [f, g] : pairs) {
    if (f != g) contact.meet(f, g);
  }
  return result;
}

std::vector<SelfIntersection> self_intersections_of(
    const SelfContacts& contacts) {
  std::vector<SelfIntersection> found;
  for (const Trace& trace : contacts.traces) {
    if (trace.first < trace.second)
      found.push_back({trace.first, trace.second,
                       place_of(*contacts.operand.solid, trace.low), false});
  }
  add_overlaps(contacts.operand, found);
  Passages(contacts.operand, *contacts.operand.solid->table).add_to(found);
  const auto key = [](const SelfIntersection& c) {
    return std::tuple(c.first, c.second, c.in_plane);
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const SelfIntersection& c, const SelfIntersection& d) {
                     return key(c) < key(d);
                   });
  found.erase(
      std::unique(found.begin(), found.end(),
                  [](const SelfIntersection& c, const SelfIntersection& d) {
                    return c.first == d.first && c.second == d.second;
                  }),
      found.end());
  return found;
}

std::vector<SelfIntersection> self_intersections(const Solid& solid) {
  return with_lease(solid, [](const Solid& same, TableLease& lease) {
    return self_intersections_of(self_contacts(same, lease));
  });
}

}  // namespace halfspace::fast
