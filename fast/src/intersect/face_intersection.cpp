#include "intersect/face_intersection.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/check.hpp"
#include "intersect/line_section.hpp"
#include "intersect/transversal_plane.hpp"

namespace halfspace::fast {

void FaceIntersector::meet(std::int32_t face_a, std::int32_t face_b) {
  if (!may_meet(face_a, face_b)) return;
  if (face(0).plane == face(1).plane) {
    meet_in_plane(0);
    meet_in_plane(1);
  } else {
    meet_across();
  }
}

void FaceIntersector::begin_block(PendingLines& pending) {
  constexpr std::size_t kSlots = 1024;
  pending.clear();
  pending_ = &pending;
  asked_cuts_.assign(kSlots, {});
}

void FaceIntersector::begin_meet(std::int32_t face_a, std::int32_t face_b) {
  const std::size_t before = pending_->lines.size();
  is_left_ = false;
  meet(face_a, face_b);
  if (!is_left_) return;
  // What was asked for is what meet() asks for first: it gets the same ids.
  pending_->shrink(before);
  PendingLine line = pending_->ends();
  line.faces = faces_;
  line.is_left = true;
  pending_->lines.push_back(line);
}

void FaceIntersector::end_meet(const PendingLines& pending, std::size_t i,
                               ContactRecords& records) {
  const PendingLine& line = pending.lines[i];
  const PendingLine before = i == 0 ? PendingLine{} : pending.lines[i - 1];
  pending_ = nullptr;
  records_ = &records;
  faces_ = line.faces;
  axis_ = line.axis;
  start_ = line.start;
  for (std::size_t o = 0; o < 2; ++o) {
    along_[o].assign(pending.along[o].begin() + before.along_end[o],
                     pending.along[o].begin() + line.along_end[o]);
  }
  events_.assign(pending.events.begin() + before.event_end,
                 pending.events.begin() + line.event_end);
  for (SweepEvent& event : events_) {
    if (event.vertex < 0)
      event.vertex = pending.ids[static_cast<std::size_t>(-1 - event.vertex)];
  }
  end_line(static_cast<std::size_t>(line.operand), line.edge);
}

/// The line is that of an edge of face `o`, in the plane of both, or, if `edge`
/// is -1, that of the faces' planes. In step 1 it is kept for step 2.
void FaceIntersector::end_line(std::size_t o, std::int32_t edge) {
  if (is_pending()) {
    if (is_left_ || events_.empty()) return;
    pending_->events.insert(pending_->events.end(), events_.begin(),
                            events_.end());
    for (std::size_t k = 0; k < 2; ++k) {
      auto& along = pending_->along[k];
      along.insert(along.end(), along_[k].begin(), along_[k].end());
    }
    PendingLine line = pending_->ends();
    line.faces = faces_;
    line.edge = edge;
    line.operand = static_cast<std::int8_t>(o);
    line.axis = static_cast<std::int8_t>(axis_);
    line.start = start_;
    pending_->lines.push_back(line);
    return;
  }
  order_events();
  if (edge < 0) {
    report_across();
  } else {
    report_in_plane(o, edge);
  }
}

bool FaceIntersector::may_meet(std::int32_t face_a, std::int32_t face_b) {
  faces_ = {face_a, face_b};
  const std::int32_t p = face(0).plane;
  const std::int32_t q = face(1).plane;
  if (p == q) return true;
  // With edge packets, the line decides which edges matter.
  const bool many = blocks_of(0) != nullptr || blocks_of(1) != nullptr;
  if ((many && !table_.line_axis(p, q, axis_)) ||
      !find_crossings(0, q, face(1).box) ||
      !find_crossings(1, p, face(0).box) ||
      (!many && !table_.line_axis(p, q, axis_)))
    return false;
  for (std::size_t o = 0; o < 2; ++o) measure(o, face(1 - o).plane);
  return low_[0] <= high_[1] && low_[1] <= high_[0];
}

/// Notes which edges of face `o` meet the plane. Whether the face does. If they
/// are many, only what matters to something in the box `near`, on the line in
/// which the planes meet.
bool FaceIntersector::find_crossings(std::size_t o, std::int32_t plane,
                                     const Box& near) {
  crossings_[o].clear();
  before_[o] = {};
  const PacketList* list = blocks_of(o);
  if (list != nullptr) return find_near_crossings(o, plane, *list, near);
  positive_ = negative_ = false;
  const std::uint32_t count = face(o).edge_count;
  if (count == 0) return true;
  find_crossings(o, plane, 0, count);
  return positive_ && negative_;
}

/// For a chain of edges before the box only the parity of its crossings
/// matters; it is odd exactly if its ends are on different sides. Closed loops
/// contribute nothing, nor does anything beyond the box.
bool FaceIntersector::find_near_crossings(std::size_t o, std::int32_t plane,
                                          const PacketList& list,
                                          const Box& near) {
  const FilterPlane& filter = table_.plane(plane).filter;
  const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
  const auto k = static_cast<std::size_t>(axis_);
  const auto matters = [&](const Box& box) {
    return box.low[k] <= near.high[k] &&
           filtered_side(filter, box, table_.rounding()) == 0;
  };
  list.visit(matters, [&](const EdgePacket& block) {
    const std::uint32_t last = block.first + block.count;
    const bool is_before = block.box.high[k] < near.low[k];
    if (is_before && block.is_closed) return;
    if (!is_before || !block.is_row) {
      find_crossings(o, plane, block.first, last);
      return;
    }
    const int from = table_.side(plane, edges[block.first].from);
    const int to = table_.side(plane, edges[last - 1].to);
    toggle(before_[o], from, to);
  });
  return !crossings_[o].empty() || before_[o][0] || before_[o][1];
}

void FaceIntersector::find_crossings(std::size_t o, std::int32_t plane,
                                     std::uint32_t first, std::uint32_t last) {
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
      crossings_[o].push_back(
          {i, static_cast<std::int8_t>(from), static_cast<std::int8_t>(to)});
    }
    if (!is_last) from = next == to_vertex ? to : table_.side(plane, next);
  }
}

/// Measures the crossings of face `o` along the line, which it is to have met.
void FaceIntersector::measure(std::size_t o, std::int32_t plane_id) {
  const FilterPlane& plane = table_.plane(plane_id).filter;
  const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
  const double r = table_.rounding();
  low_[o] = std::numeric_limits<double>::max();
  high_[o] = -low_[o];
  if (face(o).edge_count == 0) std::swap(low_[o], high_[o]);
  for (EdgeCrossing& crossing : crossings_[o]) {
    const Vertex& p = table_.vertex(edges[crossing.edge].from).approximate;
    const Vertex& q = table_.vertex(edges[crossing.edge].to).approximate;
    crossing.low = std::numeric_limits<double>::max();
    crossing.high = -crossing.low;
    const auto reach = [&](const Vertex& v) {
      crossing.low = std::min(crossing.low, coordinate(v, axis_) - v.error);
      crossing.high = std::max(crossing.high, coordinate(v, axis_) + v.error);
    };
    if (crossing.from == 0) reach(p);
    if (crossing.to == 0) reach(q);
    if (crossing.from * crossing.to < 0)
      reach(fast::meet(p, value_at(plane, p, r), q, value_at(plane, q, r), r));
    low_[o] = std::min(low_[o], crossing.low);
    high_[o] = std::max(high_[o], crossing.high);
  }
  if (blocks_of(o) == nullptr) return;
  // Where it begins or ends may be out of sight.
  std::array<bool, 2> on = before_[o];
  if (on[0] || on[1]) low_[o] = std::numeric_limits<double>::lowest();
  for (const EdgeCrossing& crossing : crossings_[o])
    toggle(on, crossing.from, crossing.to);
  if (on[0] || on[1]) high_[o] = std::numeric_limits<double>::max();
}

void FaceIntersector::begin_line() {
  events_.clear();
  // A face without edges is all of its plane.
  for (std::size_t o = 0; o < 2; ++o) {
    start_[o] = before_[o];
    if (face(o).edge_count == 0) start_[o].fill(true);
    along_[o].clear();
    is_along_[o].clear();
  }
}

/// Adds the events of face `o`, whose crossings are measured, as is the other
/// face.
void FaceIntersector::add_events(std::size_t o, std::int32_t across) {
  for (const EdgeCrossing& crossing : crossings_[o]) {
    if (crossing.low > high_[1 - o]) continue;
    if (crossing.high >= low_[1 - o]) {
      add_event(o, crossing, across);
      continue;
    }
    toggle(start_[o], crossing.from, crossing.to);
  }
}

std::int32_t FaceIntersector::ask(std::int32_t p, std::int32_t q,
                                  std::int32_t r, bool computes) {
  // After the first plane that is missing nothing is asked: meet() will, in
  // its order.
  if (is_left_) return 0;
  const AskedMeet asked = table_.ask_meet(p, q, r, computes, pending_->words);
  if (asked.known >= 0) return asked.known;
  pending_->asked.push_back(asked);
  return -static_cast<std::int32_t>(pending_->asked.size());
}

/// Asks where an edge of operand `o` meets a plane.
std::int32_t FaceIntersector::asked_cut(std::size_t o, std::int32_t id,
                                        std::int32_t across) {
  const std::size_t mixed = static_cast<std::size_t>(id) * 0x9e3779b1 ^
                            static_cast<std::size_t>(across) * 0x85ebca6b ^ o;
  AskedCut& last = asked_cuts_[mixed % asked_cuts_.size()];
  if (last.edge == id && last.across == across && last.o == o)
    return last.vertex;
  if (is_left_) return 0;
  const OperandEdge& edge = operands_[o]->edge(id);
  if (edge.other < 0) {
    leave();
    return 0;
  }
  // Each of the edge's faces asks, most often in other blocks if they are the
  // first operand's. Its first face mostly does so first.
  const bool computes = o != 0 || edge.owner == faces_[0];
  last = {o, id, across, ask(edge.plane, edge.other, across, computes)};
  return last.vertex;
}

/// Where the edge meets a plane. Each of its faces asks, and few planes cut it.
std::int32_t FaceIntersector::cut_of(OperandEdge& edge, std::int32_t across) {
  for (const std::size_t k : {0u, 1u}) {
    if (edge.cut_by[k] == across) return edge.cut_at[k];
  }
  const std::int32_t vertex =
      table_.meet(edge.plane, transversal_plane(edge, table_), across);
  edge.cut_by = {across, edge.cut_by[0]};
  edge.cut_at = {vertex, edge.cut_at[0]};
  return vertex;
}

void FaceIntersector::add_event(std::size_t o, const EdgeCrossing& crossing,
                                std::int32_t across) {
  Operand& operand = *operands_[o];
  const SolidEdge& solid_edge = operand.edges_of(faces_[o])[crossing.edge];
  const std::int32_t id = operand.edge_of[face(o).first_edge + crossing.edge];
  SweepEvent event;
  event.present[o] = true;
  if (crossing.from == 0 && crossing.to == 0) {
    // A far edge is not on the other face, whatever doubles say.
    if (id < 0) return;
    // An edge at which the surface touches itself may be there twice.
    if (is_along_[o].get(id, 0) == 0) along_[o].push_back(id);
    is_along_[o].set(id, 1);
    for (const std::int32_t end : {solid_edge.from, solid_edge.to}) {
      event.vertex = end;
      events_.push_back(event);
    }
    return;
  }
  toggle(event.toggle[o], crossing.from, crossing.to);
  if (!event.toggle[o][0] && !event.toggle[o][1]) return;
  const bool crosses = crossing.from * crossing.to < 0;
  if (is_pending() && crosses && id < 0) {
    if (solid_edge.other < 0) return leave();
    event.vertex =
        ask(face(o).plane, solid_edge.other, across, /*computes=*/false);
  } else if (id < 0 || !crosses) {
    event.vertex = line_crossing(face(o), solid_edge, crossing.from,
                                 crossing.to, across, table_);
  } else {
    event.edge[o] = id;
    event.vertex = is_pending() ? asked_cut(o, id, across)
                                : cut_of(operand.edge(id), across);
  }
  events_.push_back(event);
}

/// Puts the events in order along the axis, and makes one of those at the same
/// point.
void FaceIntersector::order_events() {
  std::sort(events_.begin(), events_.end(),
            [&](const SweepEvent& x, const SweepEvent& y) {
              return table_.compare(axis_, x.vertex, y.vertex) < 0;
            });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (kept == 0 || events_[kept - 1].vertex != events_[i].vertex) {
      events_[kept++] = events_[i];
      continue;
    }
    SweepEvent& to = events_[kept - 1];
    const SweepEvent& from = events_[i];
    for (std::size_t o = 0; o < 2; ++o) {
      to.present[o] = to.present[o] || from.present[o];
      to.edge[o] = std::max(to.edge[o], from.edge[o]);
      for (std::size_t s = 0; s < 2; ++s)
        to.toggle[o][s] = to.toggle[o][s] != from.toggle[o][s];
    }
  }
  events_.resize(kept);
  for (std::size_t o = 0; o < 2; ++o) {
    for (const std::int32_t id : along_[o]) {
      const auto [first, last] = events_at(operands_[o]->edge(id));
      ++events_[first].begun[o];
      --events_[last].begun[o];
    }
  }
  State state = start_;
  std::array<std::int32_t, 2> along{};
  for (SweepEvent& event : events_) {
    for (std::size_t o = 0; o < 2; ++o) {
      for (std::size_t s = 0; s < 2; ++s)
        state[o][s] = state[o][s] != event.toggle[o][s];
      along[o] += event.begun[o];
      event.along[o] = along[o] > 0;
    }
    event.after = state;
  }
}

/// Where the events of an edge along the line are, in their order.
std::pair<std::size_t, std::size_t> FaceIntersector::events_at(
    const OperandEdge& edge) const {
  const auto at = [this](std::int32_t vertex) {
    const auto found = std::partition_point(
        events_.begin(), events_.end(), [&](const SweepEvent& event) {
          return table_.compare(axis_, event.vertex, vertex) < 0;
        });
    return static_cast<std::size_t>(found - events_.begin());
  };
  // They may stand in the order of another axis.
  return std::minmax({at(edge.low), at(edge.high)});
}

/// The planes meet in a line, which both faces may reach at one point.
void FaceIntersector::meet_across() {
  begin_line();
  for (std::size_t o = 0; o < 2; ++o) add_events(o, face(1 - o).plane);
  end_line(0, -1);
}

void FaceIntersector::report_across() {
  report_cuts();
  for (std::size_t i = 0; i + 1 < events_.size(); ++i) {
    // Where no edge is along the line, both of its sides are alike.
    const SweepEvent& m = events_[i];
    if (m.after[0][0] && m.after[1][0] && !m.along[0] && !m.along[1]) {
      const std::int32_t high = events_[i + 1].vertex;
      HALFSPACE_CHECK(table_.compare(axis_, m.vertex, high) < 0);
      HALFSPACE_CHECK(face(0).plane != face(1).plane);
      (has_records() ? records_->segments : segments_)
          .push_back({faces_[0], faces_[1], m.vertex, high, axis_});
    }
  }
  for (std::size_t o = 0; o < 2; ++o) {
    for (const std::int32_t id : along_[o]) {
      const OperandEdge& edge = operands_[o]->edge(id);
      if (edge.owner != faces_[o]) continue;
      report_along(
          o, id,
          table_.cross_sign(edge.axis, face(o).plane, face(1 - o).plane) > 0);
    }
  }
}

/// Both faces lie in one plane: the edges of face `o` against the other face.
void FaceIntersector::meet_in_plane(std::size_t o) {
  Operand& operand = *operands_[o];
  const Box& other = face(1 - o).box;
  const SolidEdge* edges = operand.edges_of(faces_[o]);
  const auto meet_edges = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      const std::uint32_t at = face(o).first_edge + i;
      const std::int32_t id = operand.edge_of[at];
      if (id < 0 || operand.edge(id).first_edge != at ||
          is_beyond(other, table_.vertex(edges[i].from).approximate,
                    table_.vertex(edges[i].to).approximate))
        continue;
      meet_edge(o, id);
    }
  };
  const PacketList* list = blocks_of(o);
  if (list == nullptr) {
    meet_edges(0, face(o).edge_count);
    return;
  }
  list->visit(
      [&](const Box& box) { return overlap(box, other); },
      [&](const EdgePacket& block) { meet_edges(block.first, block.count); });
}

void FaceIntersector::meet_edge(std::size_t o, std::int32_t id) {
  Operand& operand = *operands_[o];
  const std::size_t p = 1 - o;
  if (is_pending() && operand.edge(id).other < 0) return leave();
  const std::int32_t across = transversal_plane(operand.edge(id), table_);
  const OperandEdge edge = operand.edge(id);
  const Vertex& low = table_.vertex(edge.low).approximate;
  const Vertex& high = table_.vertex(edge.high).approximate;
  Box near = kEmptyBox;
  extend(near, low);
  extend(near, high);
  axis_ = edge.axis;
  if (!find_crossings(p, across, near)) return;
  measure(p, across);
  low_[o] = coordinate(low, edge.axis) - low.error;
  high_[o] = coordinate(high, edge.axis) + high.error;
  if (low_[0] > high_[1] || low_[1] > high_[0]) return;
  begin_line();
  add_events(p, across);
  for (const std::int32_t end : {edge.low, edge.high}) {
    SweepEvent event;
    event.vertex = end;
    event.present[o] = true;
    events_.push_back(event);
  }
  end_line(o, id);
}

void FaceIntersector::report_in_plane(std::size_t o, std::int32_t id) {
  const std::size_t p = 1 - o;
  for (const SweepEvent& event : events_) {
    if (event.present[o] && event.has(p)) put_on_other(o, event.vertex);
  }
  const OperandEdge& edge = operands_[o]->edge(id);
  report_along(o, id,
               table_.cross_sign(edge.axis, edge.other, face(p).plane) > 0);
}

/// The points at which either face meets the other.
void FaceIntersector::report_cuts() {
  for (const SweepEvent& event : events_) {
    for (std::size_t o = 0; o < 2; ++o) {
      if (!event.present[o] || !event.has(1 - o)) continue;
      if (event.edge[o] < 0) {
        put_on_other(o, event.vertex);
      } else {
        cut(o, event.edge[o], event.vertex);
      }
    }
  }
}

/// Reports what an edge of face `o` along the line has in common with the other
/// face.
void FaceIntersector::report_along(std::size_t o, std::int32_t id,
                                   bool positive_is_left) {
  const std::size_t p = 1 - o;
  const OperandEdge edge = operands_[o]->edge(id);
  const auto [first, last] = events_at(edge);
  const bool reversed = events_[first].vertex == edge.high;
  for (std::size_t i = first; i < last; ++i) {
    const SweepEvent& event = events_[i];
    if (i > first && event.has(p)) cut(o, id, event.vertex);
    if (!event.after[p][0] && !event.after[p][1]) continue;
    EdgeInFace cover{id, event.vertex, events_[i + 1].vertex, faces_[p]};
    if (reversed) std::swap(cover.low, cover.high);
    cover.left = event.after[p][positive_is_left ? 0 : 1];
    cover.right = event.after[p][positive_is_left ? 1 : 0];
    cover.on_edge = event.along[p];
    HALFSPACE_CHECK(table_.side(face(p).plane, cover.low) == 0 &&
                    table_.side(face(p).plane, cover.high) == 0);
    HALFSPACE_CHECK(table_.compare(edge.axis, cover.low, cover.high) < 0);
    // The faces are touched: this one has the edge's end, or a cut, at the
    // event where the cover begins, and the other one is there.
    (has_records() ? records_->covers[o] : operands_[o]->covers)
        .push_back(cover);
  }
}

void FaceIntersector::cut(std::size_t o, std::int32_t edge,
                          std::int32_t vertex) {
  HALFSPACE_CHECK(table_.side(face(1 - o).plane, vertex) == 0);
  HALFSPACE_CHECK(vertex != operands_[o]->edge(edge).low &&
                  vertex != operands_[o]->edge(edge).high);
  operands_[o]->touch(faces_[o]);
  operands_[1 - o]->touch(faces_[1 - o]);
  if (operands_[o]->edge(edge).owner == faces_[o])
    (has_records() ? records_->cuts[o] : operands_[o]->cuts)
        .push_back({edge, vertex, faces_[1 - o]});
}

void FaceIntersector::put_on_other(std::size_t o, std::int32_t vertex) {
  HALFSPACE_CHECK(table_.side(face(0).plane, vertex) == 0);
  HALFSPACE_CHECK(table_.side(face(1).plane, vertex) == 0);
  operands_[o]->touch(faces_[o]);
  operands_[1 - o]->touch(faces_[1 - o]);
  if (has_records()) {
    records_->on_other[o].push_back(vertex);
  } else {
    operands_[o]->put_on_other(vertex);
  }
}

}  // namespace halfspace::fast
