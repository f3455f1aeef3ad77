#include "boolean_contact.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace halfspace::fast {

void Contact::meet(std::int32_t face_a, std::int32_t face_b) {
  faces_ = {face_a, face_b};
  if (face(0).plane == face(1).plane) {
    meet_in_plane(0);
    meet_in_plane(1);
  } else if (find_sides(0, face(1).plane) && find_sides(1, face(0).plane)) {
    meet_across();
  }
}

/// Notes the sides of face `o` against the plane that cuts it. Whether it
/// reaches the plane.
bool Contact::find_sides(std::size_t o, std::int32_t plane) {
  const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
  auto& sides = sides_[o];
  const std::uint32_t count = face(o).edge_count;
  sides.resize(count);
  if (count == 0) return true;
  bool positive = false, negative = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const int side = space_.side(plane, edges[i].from);
    sides[i][0] = static_cast<std::int8_t>(side);
    positive = positive || side >= 0;
    negative = negative || side <= 0;
  }
  if (!positive || !negative) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    // The edges of a loop stand in a row, nearly always.
    const std::uint32_t next = i + 1 < count ? i + 1 : 0;
    sides[i][1] =
        edges[next].from == edges[i].to
            ? sides[next][0]
            : static_cast<std::int8_t>(space_.side(plane, edges[i].to));
  }
  return true;
}

/// Whether the faces may overlap along the axis where they meet the line: they
/// surely do not where the doubles' bounds leave a gap.
bool Contact::may_overlap(int axis) const {
  std::array<double, 2> low, high;
  const auto coordinate = [axis](const Vertex& v) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
  };
  for (std::size_t o = 0; o < 2; ++o) {
    const FilterPlane& plane = space_.plane(face(1 - o).plane).filter;
    const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
    low[o] = std::numeric_limits<double>::max();
    high[o] = -low[o];
    if (face(o).edge_count == 0) std::swap(low[o], high[o]);
    const auto reach = [&](const Vertex& v) {
      low[o] = std::min(low[o], coordinate(v) - v.error);
      high[o] = std::max(high[o], coordinate(v) + v.error);
    };
    for (std::uint32_t i = 0; i < face(o).edge_count; ++i) {
      const auto [s, t] = sides_[o][i];
      const Vertex& p = space_.vertex(edges[i].from).approximate;
      if (s == 0) reach(p);
      if (s * t >= 0) continue;
      const Vertex& q = space_.vertex(edges[i].to).approximate;
      const double r = space_.rounding();
      reach(fast::meet(p, value_at(plane, p, r), q, value_at(plane, q, r), r));
    }
  }
  return low[0] <= high[1] && low[1] <= high[0];
}

/// Adds the marks of face `o`, whose sides against the plane `across` are
/// known.
void Contact::add_marks(std::size_t o, std::int32_t across) {
  Operand& operand = *operands_[o];
  const SolidEdge* edges = operand.edges_of(faces_[o]);
  along_[o].clear();
  for (std::uint32_t i = 0; i < face(o).edge_count; ++i) {
    const auto [s, t] = sides_[o][i];
    const std::int32_t id = operand.edge_of[face(o).first_edge + i];
    Mark mark;
    mark.present[o] = true;
    if (s == 0 && t == 0) {
      // An edge at which the surface touches itself may be there twice.
      if (std::find(along_[o].begin(), along_[o].end(), id) == along_[o].end())
        along_[o].push_back(id);
      for (const std::int32_t end : {edges[i].from, edges[i].to}) {
        mark.vertex = end;
        marks_.push_back(mark);
      }
      continue;
    }
    mark.toggle[o] = {(s > 0) != (t > 0), (s < 0) != (t < 0)};
    if (!mark.toggle[o][0] && !mark.toggle[o][1]) continue;
    if (s == 0) {
      mark.vertex = edges[i].from;
    } else if (t == 0) {
      mark.vertex = edges[i].to;
    } else {
      LineEdge& edge = operand.edge(id);
      mark.edge[o] = id;
      mark.vertex =
          space_.meet(edge.plane, second_plane(edge, operand, space_), across);
    }
    marks_.push_back(mark);
  }
}

/// Whether the faces are there before the first mark: what has no edges is.
std::array<std::array<bool, 2>, 2> Contact::far_away() const {
  const bool first = face(0).edge_count == 0;
  const bool second = face(1).edge_count == 0;
  return {{{first, first}, {second, second}}};
}

/// Puts the marks in order along the axis, and makes one of those at the same
/// point.
void Contact::order_marks(int axis) {
  std::sort(marks_.begin(), marks_.end(), [&](const Mark& x, const Mark& y) {
    return space_.compare(axis, x.vertex, y.vertex) < 0;
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
  auto state = far_away();
  for (Mark& mark : marks_) {
    for (std::size_t o = 0; o < 2; ++o) {
      for (std::size_t s = 0; s < 2; ++s)
        state[o][s] = state[o][s] != mark.toggle[o][s];
    }
    mark.after = state;
  }
  for (std::size_t o = 0; o < 2; ++o) {
    for (const std::int32_t id : along_[o]) {
      const LineEdge& edge = operands_[o]->edge(id);
      bool on = false;
      for (Mark& mark : marks_) {
        if (mark.vertex == edge.low || mark.vertex == edge.high) on = !on;
        mark.along[o] = mark.along[o] || on;
      }
    }
  }
}

/// The planes meet in a line.
void Contact::meet_across() {
  int axis = 0;
  if (!space_.line_axis(face(0).plane, face(1).plane, axis)) return;
  if (!may_overlap(axis)) return;
  marks_.clear();
  add_marks(0, face(1).plane);
  add_marks(1, face(0).plane);
  order_marks(axis);
  report_cuts();
  for (std::size_t i = 0; i + 1 < marks_.size(); ++i) {
    const Mark& m = marks_[i];
    if (m.after[0][0] && m.after[0][1] && m.after[1][0] && m.after[1][1] &&
        !m.along[0] && !m.along[1]) {
      traces_.push_back(
          {faces_[0], faces_[1], m.vertex, marks_[i + 1].vertex, axis});
    }
  }
  for (std::size_t o = 0; o < 2; ++o) {
    for (const std::int32_t id : along_[o]) {
      const LineEdge& edge = operands_[o]->edge(id);
      if (edge.owner != faces_[o]) continue;
      report_along(
          o, id,
          space_.cross_sign(edge.axis, face(o).plane, face(1 - o).plane) > 0);
    }
  }
}

/// Both faces lie in one plane: the edges of face `o` against the other face.
void Contact::meet_in_plane(std::size_t o) {
  Operand& operand = *operands_[o];
  const std::size_t p = 1 - o;
  for (std::uint32_t i = 0; i < face(o).edge_count; ++i) {
    const std::int32_t id = operand.edge_of[face(o).first_edge + i];
    if (operand.edge(id).first_edge != face(o).first_edge + i) continue;
    const std::int32_t across = second_plane(operand.edge(id), operand, space_);
    if (!find_sides(p, across)) continue;
    const LineEdge edge = operand.edge(id);
    marks_.clear();
    add_marks(p, across);
    along_[o].assign(1, id);
    for (const std::int32_t end : {edge.low, edge.high}) {
      Mark mark;
      mark.vertex = end;
      mark.present[o] = true;
      marks_.push_back(mark);
    }
    order_marks(edge.axis);
    for (const Mark& mark : marks_) {
      if (mark.present[o] && mark.has(p)) put_on_other(o, mark.vertex);
    }
    report_along(o, id,
                 space_.cross_sign(edge.axis, across, face(p).plane) > 0);
  }
}

/// The points at which either face meets the other.
void Contact::report_cuts() {
  auto before = far_away();
  for (const Mark& mark : marks_) {
    for (std::size_t o = 0; o < 2; ++o) {
      const std::size_t p = 1 - o;
      if (!mark.present[o] || !mark.has(p)) continue;
      if (mark.edge[o] < 0) {
        put_on_other(o, mark.vertex);
        continue;
      }
      const bool through = !mark.present[p] && before[p][0] && before[p][1];
      cut(o, mark.edge[o], mark.vertex, through);
    }
    before = mark.after;
  }
}

/// What an edge of face `o` along the line has in common with the other face.
/// `positive_is_left`: the first of the line's sides, in the other face's
/// plane, is on the edge's left as seen against that plane's normal.
void Contact::report_along(std::size_t o, std::int32_t id,
                           bool positive_is_left) {
  const std::size_t p = 1 - o;
  const LineEdge edge = operands_[o]->edge(id);
  bool on = false;
  bool reversed = false;  // the marks may stand in the order of another axis
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    const Mark& mark = marks_[i];
    if (mark.vertex == edge.low || mark.vertex == edge.high) {
      if (on) break;
      on = true;
      reversed = mark.vertex == edge.high;
    } else if (on && mark.has(p)) {
      cut(o, id, mark.vertex, /*through=*/false);
    }
    if (!on || (!mark.after[p][0] && !mark.after[p][1])) continue;
    Cover cover{id, mark.vertex, marks_[i + 1].vertex, faces_[p]};
    if (reversed) std::swap(cover.low, cover.high);
    cover.left = mark.after[p][positive_is_left ? 0 : 1];
    cover.right = mark.after[p][positive_is_left ? 1 : 0];
    cover.on_edge = mark.along[p];
    operands_[o]->covers.push_back(cover);
    // Its ends are met by what is around the marks.
    operands_[0]->touched[static_cast<std::size_t>(faces_[0])] = 1;
    operands_[1]->touched[static_cast<std::size_t>(faces_[1])] = 1;
  }
}

void Contact::cut(std::size_t o, std::int32_t edge, std::int32_t vertex,
                  bool through) {
  operands_[o]->touched[static_cast<std::size_t>(faces_[o])] = 1;
  operands_[1 - o]->touched[static_cast<std::size_t>(faces_[1 - o])] = 1;
  if (operands_[o]->edge(edge).owner == faces_[o])
    operands_[o]->cuts.push_back({edge, vertex, faces_[1 - o], through});
}

void Contact::put_on_other(std::size_t o, std::int32_t vertex) {
  operands_[o]->touched[static_cast<std::size_t>(faces_[o])] = 1;
  operands_[1 - o]->touched[static_cast<std::size_t>(faces_[1 - o])] = 1;
  operands_[o]->put_on_other(vertex);
}

}  // namespace halfspace::fast
