#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "intersect/face_intersection.hpp"

namespace halfspace::fast {

bool Contact::may_meet(std::int32_t face_a, std::int32_t face_b) {
  faces_ = {face_a, face_b};
  const std::int32_t p = face(0).plane;
  const std::int32_t q = face(1).plane;
  if (p == q) return true;
  // Where a face has many edges the line tells which of them matter.
  const bool many = blocks_of(0) != nullptr || blocks_of(1) != nullptr;
  if ((many && !table_.line_axis(p, q, axis_)) ||
      !find_hits(0, q, face(1).box) || !find_hits(1, p, face(0).box) ||
      (!many && !table_.line_axis(p, q, axis_)))
    return false;
  for (std::size_t o = 0; o < 2; ++o) measure(o, face(1 - o).plane);
  return low_[0] <= high_[1] && low_[1] <= high_[0];
}

/// Notes which edges of face `o` meet the plane. Whether the face does. If they
/// are many, only what matters to something in the box `near`, on the line in
/// which the planes meet.
bool Contact::find_hits(std::size_t o, std::int32_t plane, const Box& near) {
  hits_[o].clear();
  before_[o] = {};
  const BlockList* list = blocks_of(o);
  if (list != nullptr) return find_near_hits(o, plane, *list, near);
  positive_ = negative_ = false;
  const std::uint32_t count = face(o).edge_count;
  if (count == 0) return true;
  find_hits(o, plane, 0, count);
  return positive_ && negative_;
}

/// Of a row of edges before what is in the box it matters only whether it
/// begins and ends on one side, for each other crossing has one back; whole
/// loops do. What is beyond the box does not matter.
bool Contact::find_near_hits(std::size_t o, std::int32_t plane,
                             const BlockList& list, const Box& near) {
  const FilterPlane& filter = table_.plane(plane).filter;
  const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
  const auto k = static_cast<std::size_t>(axis_);
  const auto matters = [&](const Box& box) {
    return box.low[k] <= near.high[k] &&
           known_side(filter, box, table_.rounding()) == 0;
  };
  list.visit(matters, [&](const EdgeBlock& block) {
    const std::uint32_t last = block.first + block.count;
    const bool is_before = block.box.high[k] < near.low[k];
    if (is_before && block.is_closed) return;
    if (!is_before || !block.is_row) {
      find_hits(o, plane, block.first, last);
      return;
    }
    const int from = table_.side(plane, edges[block.first].from);
    const int to = table_.side(plane, edges[last - 1].to);
    toggle(before_[o], from, to);
  });
  return !hits_[o].empty() || before_[o][0] || before_[o][1];
}

void Contact::find_hits(std::size_t o, std::int32_t plane, std::uint32_t first,
                        std::uint32_t last) {
  const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
  const int start = table_.side(plane, edges[first].from);
  int from = start;
  for (std::uint32_t i = first; i < last; ++i) {
    // The edges of a loop stand in a row, nearly always.
    const bool is_last = i + 1 == last;
    const std::int32_t to_vertex = edges[i].to;
    const std::int32_t next = edges[is_last ? first : i + 1].from;
    const int to =
        is_last && next == to_vertex ? start : table_.side(plane, to_vertex);
    positive_ = positive_ || from >= 0 || to >= 0;
    negative_ = negative_ || from <= 0 || to <= 0;
    if (from != to || from == 0) {
      hits_[o].push_back(
          {i, static_cast<std::int8_t>(from), static_cast<std::int8_t>(to)});
    }
    if (!is_last) from = next == to_vertex ? to : table_.side(plane, next);
  }
}

/// Measures the hits of face `o` along the line, which it is to have met.
void Contact::measure(std::size_t o, std::int32_t plane_id) {
  const FilterPlane& plane = table_.plane(plane_id).filter;
  const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
  const double r = table_.rounding();
  low_[o] = std::numeric_limits<double>::max();
  high_[o] = -low_[o];
  if (face(o).edge_count == 0) std::swap(low_[o], high_[o]);
  for (Hit& hit : hits_[o]) {
    const Vertex& p = table_.vertex(edges[hit.edge].from).approximate;
    const Vertex& q = table_.vertex(edges[hit.edge].to).approximate;
    hit.low = std::numeric_limits<double>::max();
    hit.high = -hit.low;
    const auto reach = [&](const Vertex& v) {
      hit.low = std::min(hit.low, coordinate(v, axis_) - v.error);
      hit.high = std::max(hit.high, coordinate(v, axis_) + v.error);
    };
    if (hit.from == 0) reach(p);
    if (hit.to == 0) reach(q);
    if (hit.from * hit.to < 0)
      reach(fast::meet(p, value_at(plane, p, r), q, value_at(plane, q, r), r));
    low_[o] = std::min(low_[o], hit.low);
    high_[o] = std::max(high_[o], hit.high);
  }
  if (blocks_of(o) == nullptr) return;
  // Where it begins or ends may be out of sight.
  std::array<bool, 2> on = before_[o];
  if (on[0] || on[1]) low_[o] = std::numeric_limits<double>::lowest();
  for (const Hit& hit : hits_[o]) toggle(on, hit.from, hit.to);
  if (on[0] || on[1]) high_[o] = std::numeric_limits<double>::max();
}

}  // namespace halfspace::fast
