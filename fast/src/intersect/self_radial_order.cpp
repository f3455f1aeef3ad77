#include "intersect/self_radial_order.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "base/disjoint_sets.hpp"
#include "intersect/line_section.hpp"
#include "intersect/transversal_plane.hpp"

namespace halfspace::fast {
namespace {

const Operand& with_index(Operand& operand, const DynamicBvh& index) {
  operand.index = &index;
  return operand;
}

}  // namespace

DynamicBvh index_of(const Solid& solid) {
  DynamicBvh index;
  index.add(solid, 0);
  return index;
}

SelfRadialOrder::SelfRadialOrder(const Solid& solid, TableLease& lease)
    : SelfRadialOrder(solid, lease, self_contacts(solid, lease),
                      index_of(solid)) {}

SelfRadialOrder::SelfRadialOrder(const Solid& solid, TableLease& lease,
                                 SelfContacts contacts, DynamicBvh index)
    : solid_(solid),
      table_(lease.table()),
      contacts_(std::move(contacts)),
      index_(std::move(index)),
      locator_(with_index(contacts_.operand, index_), table_) {}

const std::vector<HalfFace>& SelfRadialOrder::at(const Segment& segment) {
  half_faces_.clear();
  Box box = kEmptyBox;
  extend(box, table_.vertex(segment.low).approximate);
  extend(box, table_.vertex(segment.high).approximate);
  std::vector<std::int32_t> near;
  index_.find(box, [&](std::int32_t f) {
    if (table_.side(face(f).plane, segment.low) == 0 &&
        table_.side(face(f).plane, segment.high) == 0)
      near.push_back(f);
  });
  std::sort(near.begin(), near.end());
  for (const std::int32_t f : near) add_half_faces(f, segment);
  if (!half_faces_.empty()) radial_sort(half_faces_, segment.axis, table_);
  return half_faces_;
}

/// Seen from right beside the line, on either side, the face begins and ends
/// where its edges cross that side.
void SelfRadialOrder::add_half_faces(std::int32_t f, const Segment& segment) {
  const Face& of = face(f);
  const std::int32_t across = other_than(of.plane, segment.planes);
  HALFSPACE_CHECK(table_.side(across, segment.low) == 0 &&
                  table_.side(across, segment.high) == 0);
  HALFSPACE_CHECK(across != of.plane);
  bool positive = false, negative = false;
  for (std::uint32_t i = 0; i < of.edge_count; ++i) {
    const SolidEdge& edge = solid_.edges[of.first_edge + i];
    const int from = table_.side(across, edge.from);
    const int to = table_.side(across, edge.to);
    const bool on_positive = (from > 0) != (to > 0);
    const bool on_negative = (from < 0) != (to < 0);
    if (!on_positive && !on_negative) continue;
    const std::int32_t at = line_crossing(of, edge, from, to, across, table_);
    if (table_.compare(segment.axis, at, segment.low) > 0) continue;
    positive = positive != on_positive;
    negative = negative != on_negative;
  }
  const bool positive_is_left =
      table_.cross_sign(segment.axis, across, of.plane) > 0;
  if (positive_is_left ? positive : negative)
    half_faces_.push_back({0, f, of.plane, 1, of.flipped});
  if (positive_is_left ? negative : positive)
    half_faces_.push_back({0, f, of.plane, -1, of.flipped});
}

/// The winding number of the wedge before the first half-face.
///
/// The point location gives that of the wedge that holds a point beside the
/// segment, in a direction D that has a sign against every plane. The angle
/// from a half-face to D has a sine of that sign, times the turn of the
/// half-face.
int SelfRadialOrder::winding_before_first(const Segment& segment) const {
  const auto sine = [this](const HalfFace& w) {
    for (const int axis : {0, 2, 1}) {
      const int sign = table_.normal_sign(w.plane, axis);
      if (sign != 0) return sign * w.turn;
    }
    return 0;
  };
  int winding = locator_.winding(segment.low, segment.high);
  if (winding_of_rest_) winding += winding_of_rest_(segment.low, segment.high);
  // Faces that are no region of their plane may have no half_face at their
  // edge.
  if (half_faces_.empty()) return winding;
  const HalfFace& first = half_faces_.front();
  const bool within_half = sine(first) > 0;
  for (const HalfFace& w : half_faces_) {
    const int part = part_of_turn(first, w, segment.axis, table_);
    const int doubtful = within_half ? 1 : 3;
    if (part < doubtful || (part == doubtful && sine(w) > 0))
      winding -= change(w);
  }
  return winding;
}

int SelfRadialOrder::winding_outside(std::int32_t f) {
  Operand& operand = contacts_.operand;
  OperandEdge& edge = operand.edge(operand.edge_of[face(f).first_edge]);
  const Segment segment{edge.low,
                        edge.high,
                        edge.axis,
                        {edge.plane, transversal_plane(edge, table_)}};
  at(segment);
  int winding = winding_before_first(segment);
  for (const HalfFace& half_face : half_faces_) {
    const int next = winding + change(half_face);
    if (half_face.face == f) return std::min(winding, next);
    winding = next;
  }
  return winding;
}

std::vector<std::int32_t> parts_of_surface(
    const Operand& operand, const std::vector<std::uint8_t>& left_out) {
  DisjointSets faces(left_out.size());
  for (const OperandEdge& edge : operand.edges) {
    if (edge.use_count != 2) continue;
    const std::int32_t f = operand.uses[edge.first_use].face;
    const std::int32_t g = operand.uses[edge.first_use + 1].face;
    if (left_out[static_cast<std::size_t>(f)] != 0 ||
        left_out[static_cast<std::size_t>(g)] != 0)
      continue;
    faces.unite(f, g);
  }
  std::vector<std::int32_t> parts(left_out.size());
  for (std::size_t f = 0; f < parts.size(); ++f)
    parts[f] = faces.root(static_cast<std::int32_t>(f));
  return parts;
}

}  // namespace halfspace::fast
