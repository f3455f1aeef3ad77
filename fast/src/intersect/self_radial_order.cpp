#include "intersect/self_radial_order.hpp"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.hpp"

namespace halfspace::fast {
namespace {

FaceIndex index_of(const Solid& solid) {
  FaceIndex index;
  index.add(solid, 0);
  return index;
}

const Operand& with_index(Operand& operand, const FaceIndex& index) {
  operand.index = &index;
  return operand;
}

}  // namespace

SelfWings::SelfWings(const Solid& solid, TableLease& lease)
    : solid_(solid),
      table_(lease.table()),
      contacts_(self_contacts(solid, lease)),
      index_(index_of(solid)),
      locator_(with_index(contacts_.operand, index_), table_) {}

const std::vector<Wing>& SelfWings::at(const Segment& segment) {
  wings_.clear();
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
  for (const std::int32_t f : near) add_wings(f, segment);
  if (!wings_.empty()) sort_wings(wings_, segment.axis, table_);
  return wings_;
}

/// Seen from right beside the line, on either side, the face begins and ends
/// where its edges cross that side.
void SelfWings::add_wings(std::int32_t f, const Segment& segment) {
  const Face& of = face(f);
  const std::int32_t across = other_than(of.plane, segment.planes);
  bool positive = false, negative = false;
  for (std::uint32_t i = 0; i < of.edge_count; ++i) {
    const SolidEdge& edge = solid_.edges[of.first_edge + i];
    const int from = table_.side(across, edge.from);
    const int to = table_.side(across, edge.to);
    const bool on_positive = (from > 0) != (to > 0);
    const bool on_negative = (from < 0) != (to < 0);
    if (!on_positive && !on_negative) continue;
    const std::int32_t at =
        from == 0 ? edge.from
        : to == 0
            ? edge.to
            : table_.meet(of.plane, plane_athwart(edge, of, table_), across);
    if (table_.compare(segment.axis, at, segment.low) > 0) continue;
    positive = positive != on_positive;
    negative = negative != on_negative;
  }
  const bool positive_is_left =
      table_.cross_sign(segment.axis, across, of.plane) > 0;
  if (positive_is_left ? positive : negative)
    wings_.push_back({0, f, of.plane, 1, of.flipped});
  if (positive_is_left ? negative : positive)
    wings_.push_back({0, f, of.plane, -1, of.flipped});
}

/// How often the surface winds round the wedge before the first wing.
///
/// The locator tells of the wedge that holds a point beside the segment, in a
/// direction D that has a sign against every plane. The angle from a wing to D
/// has a sine of that sign, times the wing's turn.
int SelfWings::level_before_first(const Segment& segment) const {
  const auto sine = [this](const Wing& w) {
    for (const int axis : {0, 2, 1}) {
      const int sign = table_.normal_sign(w.plane, axis);
      if (sign != 0) return sign * w.turn;
    }
    return 0;
  };
  int level = locator_.winding(segment.low, segment.high);
  // Faces that are no region of their plane may have no wing at their edge.
  if (wings_.empty()) return level;
  const Wing& first = wings_.front();
  const bool within_half = sine(first) > 0;
  for (const Wing& w : wings_) {
    const int part = part_of_turn(first, w, segment.axis, table_);
    const int doubtful = within_half ? 1 : 3;
    if (part < doubtful || (part == doubtful && sine(w) > 0))
      level -= change(w);
  }
  return level;
}

int SelfWings::level_outside(std::int32_t f) {
  Operand& operand = contacts_.operand;
  LineEdge& edge = operand.edge(operand.edge_of[face(f).first_edge]);
  const Segment segment{edge.low,
                        edge.high,
                        edge.axis,
                        {edge.plane, second_plane(edge, operand, table_)}};
  at(segment);
  int level = level_before_first(segment);
  for (const Wing& wing : wings_) {
    const int next = level + change(wing);
    if (wing.face == f) return std::min(level, next);
    level = next;
  }
  return level;
}

std::vector<std::int32_t> parts_of_surface(
    const Operand& operand, const std::vector<std::uint8_t>& left_out) {
  DisjointSets faces(left_out.size());
  for (const LineEdge& edge : operand.edges) {
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
