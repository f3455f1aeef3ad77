#include "intersect/self_intersections.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "intersect/radial_order.hpp"
#include "intersect/self_radial_order.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

/// Where faces in one plane begin to overlap: an edge of one with both of them
/// on the same side of it.
void add_overlaps(const Operand& a, std::vector<SelfIntersection>& found) {
  for (const EdgeInFace& cover : a.covers) {
    const OperandEdge& edge = a.edges[static_cast<std::size_t>(cover.edge)];
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
class AlternationCheck {
 public:
  AlternationCheck(const Operand& operand, const GeometryTable& table)
      : operand_(operand), table_(table), covers_(operand.covers) {
    std::sort(covers_.begin(), covers_.end(),
              [](const EdgeInFace& c, const EdgeInFace& d) {
                return c.edge < d.edge;
              });
  }

  void add_to(std::vector<SelfIntersection>& found) {
    auto cover = covers_.begin();
    for (std::size_t e = 0; e < operand_.edges.size(); ++e) {
      const auto first = cover;
      while (cover != covers_.end() &&
             static_cast<std::size_t>(cover->edge) == e)
        ++cover;
      const OperandEdge& edge = operand_.edges[e];
      others_.assign(first, cover);
      std::erase_if(others_,
                    [&](const EdgeInFace& c) { return is_of(c.face, edge); });
      if (edge.use_count > 2 || !others_.empty()) add_edge(edge, found);
    }
  }

 private:
  bool is_of(std::int32_t face, const OperandEdge& edge) const {
    const auto first = operand_.uses.begin() + edge.first_use;
    return std::any_of(first, first + edge.use_count,
                       [&](const EdgeUse& use) { return use.face == face; });
  }
  bool is_before(int axis, std::int32_t u, std::int32_t v) const {
    return u != v && table_.compare(axis, u, v) < 0;
  }

  void add_edge(const OperandEdge& edge, std::vector<SelfIntersection>& found);
  void add_half_face(std::int32_t face, int turn) {
    const Face& of = operand_.face(face);
    half_faces_.push_back({0, face, of.plane, turn, of.flipped});
  }

  const Operand& operand_;
  const GeometryTable& table_;
  List<EdgeInFace> covers_;         ///< by edge
  std::vector<EdgeInFace> others_;  ///< of the current edge, by other faces
  std::vector<std::int32_t> ends_;  ///< of its parts
  std::vector<HalfFace> half_faces_;
};

void AlternationCheck::add_edge(const OperandEdge& edge,
                                std::vector<SelfIntersection>& found) {
  const int axis = edge.axis;
  ends_ = {edge.low, edge.high};
  for (const EdgeInFace& cover : others_)
    ends_.insert(ends_.end(), {cover.low, cover.high});
  std::sort(ends_.begin(), ends_.end(), [&](std::int32_t u, std::int32_t v) {
    return is_before(axis, u, v);
  });
  ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
  for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
    half_faces_.clear();
    for (std::uint32_t u = 0; u < edge.use_count; ++u) {
      const EdgeUse& use = operand_.uses[edge.first_use + u];
      add_half_face(use.face,
                    use.forward != operand_.face(use.face).flipped ? 1 : -1);
    }
    for (const EdgeInFace& cover : others_) {
      if (is_before(axis, ends_[i], cover.low) ||
          is_before(axis, cover.high, ends_[i + 1]))
        continue;
      if (cover.left) add_half_face(cover.face, 1);
      if (cover.right) add_half_face(cover.face, -1);
    }
    int sum = 0;
    for (const HalfFace& half_face : half_faces_) sum += change(half_face);
    // At a boundary of an open surface there is nothing to alternate.
    if (half_faces_.size() <= 2 || sum != 0) continue;
    // Which of those in one place are neighbours does not depend on covers.
    std::sort(half_faces_.begin(), half_faces_.end(),
              [](const HalfFace& w, const HalfFace& v) {
                return std::tie(w.face, w.turn) < std::tie(v.face, v.turn);
              });
    radial_sort(half_faces_, axis, table_);
    for (std::size_t w = 0; w < half_faces_.size(); ++w) {
      const HalfFace& last =
          half_faces_[w == 0 ? half_faces_.size() - 1 : w - 1];
      const HalfFace& half_face = half_faces_[w];
      if (half_face.face == last.face || change(half_face) != change(last))
        continue;
      const bool same =
          half_face.plane == last.plane && half_face.turn == last.turn;
      found.push_back({std::min(half_face.face, last.face),
                       std::max(half_face.face, last.face),
                       place_of(*operand_.solid, ends_[i]), same});
    }
  }
}

}  // namespace

std::vector<SelfIntersection> self_intersections_of(
    const SelfContacts& contacts) {
  std::vector<SelfIntersection> found;
  for (const IntersectionSegment& trace : contacts.segments) {
    if (trace.first < trace.second)
      found.push_back({trace.first, trace.second,
                       place_of(*contacts.operand.solid, trace.low), false});
  }
  add_overlaps(contacts.operand, found);
  AlternationCheck(contacts.operand, *contacts.operand.solid->table)
      .add_to(found);
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
    const SurfaceEdges edges(same);
    const FacePairs pairs =
        undecided_pairs(same, lease.table(), edges, index_of(same), {});
    return self_intersections_of(self_contacts(same, lease, edges, pairs));
  });
}

}  // namespace halfspace::fast
