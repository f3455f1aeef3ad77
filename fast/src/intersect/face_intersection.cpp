#include "intersect/face_intersection.hpp"

#include <algorithm>
#include <utility>

namespace halfspace::fast {

void Contact::meet(std::int32_t face_a, std::int32_t face_b) {
  if (!may_meet(face_a, face_b)) return;
  if (face(0).plane == face(1).plane) {
    meet_in_plane(0);
    meet_in_plane(1);
  } else {
    meet_across();
  }
}

void Contact::begin_line() {
  marks_.clear();
  // What has no edges is everywhere.
  for (std::size_t o = 0; o < 2; ++o) {
    start_[o] = before_[o];
    if (face(o).edge_count == 0) start_[o].fill(true);
    along_[o].clear();
    is_along_[o].clear();
  }
}

/// Adds the marks of face `o`, whose hits are measured, as is the other face.
void Contact::add_marks(std::size_t o, std::int32_t across) {
  for (const Hit& hit : hits_[o]) {
    if (hit.low > high_[1 - o]) continue;
    if (hit.high >= low_[1 - o]) {
      add_mark(o, hit, across);
      continue;
    }
    toggle(start_[o], hit.from, hit.to);
  }
}

/// Where the edge meets a plane. Each of its faces asks, and few planes cut it.
std::int32_t Contact::cut_of(std::size_t o, LineEdge& edge,
                             std::int32_t across) {
  for (const std::size_t k : {0u, 1u}) {
    if (edge.cut_by[k] == across) return edge.cut_at[k];
  }
  const std::int32_t vertex = table_.meet(
      edge.plane, second_plane(edge, *operands_[o], table_), across);
  edge.cut_by = {across, edge.cut_by[0]};
  edge.cut_at = {vertex, edge.cut_at[0]};
  return vertex;
}

void Contact::add_mark(std::size_t o, const Hit& hit, std::int32_t across) {
  Operand& operand = *operands_[o];
  const SolidEdge& solid_edge = operand.edges_of(faces_[o])[hit.edge];
  const std::int32_t id = operand.edge_of[face(o).first_edge + hit.edge];
  Mark mark;
  mark.present[o] = true;
  if (hit.from == 0 && hit.to == 0) {
    // A far edge is not on the other face, whatever doubles say.
    if (id < 0) return;
    // An edge at which the surface touches itself may be there twice.
    if (is_along_[o].get(id, 0) == 0) along_[o].push_back(id);
    is_along_[o].set(id, 1);
    for (const std::int32_t end : {solid_edge.from, solid_edge.to}) {
      mark.vertex = end;
      marks_.push_back(mark);
    }
    return;
  }
  toggle(mark.toggle[o], hit.from, hit.to);
  if (!mark.toggle[o][0] && !mark.toggle[o][1]) return;
  if (hit.from == 0) {
    mark.vertex = solid_edge.from;
  } else if (hit.to == 0) {
    mark.vertex = solid_edge.to;
  } else if (id < 0) {
    mark.vertex = table_.meet(
        face(o).plane, plane_athwart(solid_edge, face(o), table_), across);
  } else {
    LineEdge& edge = operand.edge(id);
    mark.edge[o] = id;
    mark.vertex = cut_of(o, edge, across);
  }
  marks_.push_back(mark);
}

/// Puts the marks in order along the axis, and makes one of those at the same
/// point.
void Contact::order_marks() {
  std::sort(marks_.begin(), marks_.end(), [&](const Mark& x, const Mark& y) {
    return table_.compare(axis_, x.vertex, y.vertex) < 0;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    if (kept == 0 || marks_[kept - 1].vertex != marks_[i].vertex) {
      marks_[kept++] = marks_[i];
      continue;
    }
    Mark& to = marks_[kept - 1];
    const Mark& from = marks_[i];
    for (std::size_t o = 0; o < 2; ++o) {
      to.present[o] = to.present[o] || from.present[o];
      to.edge[o] = std::max(to.edge[o], from.edge[o]);
      for (std::size_t s = 0; s < 2; ++s)
        to.toggle[o][s] = to.toggle[o][s] != from.toggle[o][s];
    }
  }
  marks_.resize(kept);
  for (std::size_t o = 0; o < 2; ++o) {
    for (const std::int32_t id : along_[o]) {
      const auto [first, last] = marks_at(operands_[o]->edge(id));
      ++marks_[first].begun[o];
      --marks_[last].begun[o];
    }
  }
  State state = start_;
  std::array<std::int32_t, 2> along{};
  for (Mark& mark : marks_) {
    for (std::size_t o = 0; o < 2; ++o) {
      for (std::size_t s = 0; s < 2; ++s)
        state[o][s] = state[o][s] != mark.toggle[o][s];
      along[o] += mark.begun[o];
      mark.along[o] = along[o] > 0;
    }
    mark.after = state;
  }
}

/// Where the marks of an edge along the line are, in their order.
std::pair<std::size_t, std::size_t> Contact::marks_at(
    const LineEdge& edge) const {
  const auto at = [this](std::int32_t vertex) {
    const auto found = std::partition_point(
        marks_.begin(), marks_.end(), [&](const Mark& mark) {
          return table_.compare(axis_, mark.vertex, vertex) < 0;
        });
    return static_cast<std::size_t>(found - marks_.begin());
  };
  // They may stand in the order of another axis.
  return std::minmax({at(edge.low), at(edge.high)});
}

/// The planes meet in a line, which both faces may reach at one point.
void Contact::meet_across() {
  begin_line();
  for (std::size_t o = 0; o < 2; ++o) add_marks(o, face(1 - o).plane);
  order_marks();
  report_cuts();
  for (std::size_t i = 0; i + 1 < marks_.size(); ++i) {
    // Where no edge is along the line, both of its sides are alike.
    const Mark& m = marks_[i];
    if (m.after[0][0] && m.after[1][0] && !m.along[0] && !m.along[1]) {
      traces_.push_back(
          {faces_[0], faces_[1], m.vertex, marks_[i + 1].vertex, axis_});
    }
  }
  for (std::size_t o = 0; o < 2; ++o) {
    for (const std::int32_t id : along_[o]) {
      const LineEdge& edge = operands_[o]->edge(id);
      if (edge.owner != faces_[o]) continue;
      report_along(
          o, id,
          table_.cross_sign(edge.axis, face(o).plane, face(1 - o).plane) > 0);
    }
  }
}

/// Both faces lie in one plane: the edges of face `o` against the other face.
void Contact::meet_in_plane(std::size_t o) {
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
  const BlockList* list = blocks_of(o);
  if (list == nullptr) {
    meet_edges(0, face(o).edge_count);
    return;
  }
  list->visit(
      [&](const Box& box) { return overlap(box, other); },
      [&](const EdgeBlock& block) { meet_edges(block.first, block.count); });
}

void Contact::meet_edge(std::size_t o, std::int32_t id) {
  Operand& operand = *operands_[o];
  const std::size_t p = 1 - o;
  const std::int32_t across = second_plane(operand.edge(id), operand, table_);
  const LineEdge edge = operand.edge(id);
  const Vertex& low = table_.vertex(edge.low).approximate;
  const Vertex& high = table_.vertex(edge.high).approximate;
  Box near = kEmptyBox;
  extend(near, low);
  extend(near, high);
  axis_ = edge.axis;
  if (!find_hits(p, across, near)) return;
  measure(p, across);
  low_[o] = coordinate(low, edge.axis) - low.error;
  high_[o] = coordinate(high, edge.axis) + high.error;
  if (low_[0] > high_[1] || low_[1] > high_[0]) return;
  begin_line();
  add_marks(p, across);
  for (const std::int32_t end : {edge.low, edge.high}) {
    Mark mark;
    mark.vertex = end;
    mark.present[o] = true;
    marks_.push_back(mark);
  }
  order_marks();
  for (const Mark& mark : marks_) {
    if (mark.present[o] && mark.has(p)) put_on_other(o, mark.vertex);
  }
  report_along(o, id, table_.cross_sign(edge.axis, across, face(p).plane) > 0);
}

/// The points at which either face meets the other.
void Contact::report_cuts() {
  for (const Mark& mark : marks_) {
    for (std::size_t o = 0; o < 2; ++o) {
      if (!mark.present[o] || !mark.has(1 - o)) continue;
      if (mark.edge[o] < 0) {
        put_on_other(o, mark.vertex);
      } else {
        cut(o, mark.edge[o], mark.vertex);
      }
    }
  }
}

/// What an edge of face `o` along the line has in common with the other face.
/// `positive_is_left`: the first of the line's sides, in the other face's
/// plane, is on the edge's left as seen against that plane's normal.
void Contact::report_along(std::size_t o, std::int32_t id,
                           bool positive_is_left) {
  const std::size_t p = 1 - o;
  const LineEdge edge = operands_[o]->edge(id);
  const auto [first, last] = marks_at(edge);
  const bool reversed = marks_[first].vertex == edge.high;
  for (std::size_t i = first; i < last; ++i) {
    const Mark& mark = marks_[i];
    if (i > first && mark.has(p)) cut(o, id, mark.vertex);
    if (!mark.after[p][0] && !mark.after[p][1]) continue;
    Cover cover{id, mark.vertex, marks_[i + 1].vertex, faces_[p]};
    if (reversed) std::swap(cover.low, cover.high);
    cover.left = mark.after[p][positive_is_left ? 0 : 1];
    cover.right = mark.after[p][positive_is_left ? 1 : 0];
    cover.on_edge = mark.along[p];
    // The faces are touched: this one has the edge's end, or a cut, at the mark
    // where the cover begins, and the other one is there.
    operands_[o]->covers.push_back(cover);
  }
}

void Contact::cut(std::size_t o, std::int32_t edge, std::int32_t vertex) {
  operands_[o]->touched[static_cast<std::size_t>(faces_[o])] = 1;
  operands_[1 - o]->touched[static_cast<std::size_t>(faces_[1 - o])] = 1;
  if (operands_[o]->edge(edge).owner == faces_[o])
    operands_[o]->cuts.push_back({edge, vertex, faces_[1 - o]});
}

void Contact::put_on_other(std::size_t o, std::int32_t vertex) {
  operands_[o]->touched[static_cast<std::size_t>(faces_[o])] = 1;
  operands_[1 - o]->touched[static_cast<std::size_t>(faces_[1 - o])] = 1;
  operands_[o]->put_on_other(vertex);
}

}  // namespace halfspace::fast
