#include "boolean_contact.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace halfspace::fast {

namespace {

/// So many edges in a row have a box, in faces with many more.
constexpr std::uint32_t kBlock = 16;
constexpr std::uint32_t kManyEdges = 3 * kBlock;

double coordinate(const Vertex& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Which side of the plane the box is on, or 0 if it may meet it.
int known_side(const FilterPlane& plane, const Box& box, double rounding) {
  double at[3];
  double radius = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = (double{box.low[k]} + double{box.high[k]}) / 2;
    radius = std::max(radius, double{box.high[k]} - double{box.low[k]});
  }
  // No point of the box is off its middle by more than half of that; the
  // middle is rounded by less than 2^-20 of it, where it is rounded at all.
  const Vertex middle{at[0], at[1], at[2], radius * (0.5 + 0x1p-20)};
  return known_sign(value_at(plane, middle, rounding));
}

}  // namespace

bool Contact::may_meet(std::int32_t face_a, std::int32_t face_b) {
  faces_ = {face_a, face_b};
  if (face(0).plane == face(1).plane) return true;
  if (!find_hits(0, face(1).plane) || !find_hits(1, face(0).plane) ||
      !space_.line_axis(face(0).plane, face(1).plane, axis_))
    return false;
  for (std::size_t o = 0; o < 2; ++o) measure(o, face(1 - o).plane, axis_);
  return low_[0] <= high_[1] && low_[1] <= high_[0];
}

void Contact::meet(std::int32_t face_a, std::int32_t face_b) {
  if (!may_meet(face_a, face_b)) return;
  if (face(0).plane == face(1).plane) {
    meet_in_plane(0);
    meet_in_plane(1);
  } else {
    meet_across();
  }
}

/// The boxes of face `o`'s edges, if they are many.
std::span<const Box> Contact::blocks_of(std::size_t o) {
  const std::uint32_t count = face(o).edge_count;
  if (count < kManyEdges) return {};
  std::vector<Box>& blocks = blocks_[o];
  std::int32_t& first = first_block_[o][static_cast<std::size_t>(faces_[o])];
  if (first < 0) {
    first = static_cast<std::int32_t>(blocks.size());
    const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (i % kBlock == 0) blocks.push_back(kEmptyBox);
      extend(blocks.back(), space_.vertex(edges[i].from).approximate);
      extend(blocks.back(), space_.vertex(edges[i].to).approximate);
    }
  }
  return std::span(blocks).subspan(static_cast<std::size_t>(first),
                                   (count + kBlock - 1) / kBlock);
}

/// Notes which edges of face `o` meet the plane. Whether the face does.
bool Contact::find_hits(std::size_t o, std::int32_t plane) {
  hits_[o].clear();
  positive_ = negative_ = false;
  const std::uint32_t count = face(o).edge_count;
  if (count == 0) return true;
  const auto blocks = blocks_of(o);
  if (blocks.empty()) find_hits(o, plane, 0, count);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const int side =
        known_side(space_.plane(plane).filter, blocks[b], space_.rounding());
    positive_ = positive_ || side > 0;
    negative_ = negative_ || side < 0;
    const auto first = static_cast<std::uint32_t>(b) * kBlock;
    if (side == 0) find_hits(o, plane, first, std::min(first + kBlock, count));
  }
  return positive_ && negative_;
}

void Contact::find_hits(std::size_t o, std::int32_t plane, std::uint32_t first,
                        std::uint32_t last) {
  const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
  const int start = space_.side(plane, edges[first].from);
  int from = start;
  for (std::uint32_t i = first; i < last; ++i) {
    // The edges of a loop stand in a row, nearly always.
    const bool is_last = i + 1 == last;
    const std::int32_t to_vertex = edges[i].to;
    const std::int32_t next = edges[is_last ? first : i + 1].from;
    const int to =
        is_last && next == to_vertex ? start : space_.side(plane, to_vertex);
    positive_ = positive_ || from >= 0 || to >= 0;
    negative_ = negative_ || from <= 0 || to <= 0;
    if (from != to || from == 0) {
      hits_[o].push_back(
          {i, static_cast<std::int8_t>(from), static_cast<std::int8_t>(to)});
    }
    if (!is_last) from = next == to_vertex ? to : space_.side(plane, next);
  }
}

/// Measures the hits of face `o` along the line, which it is to have met.
void Contact::measure(std::size_t o, std::int32_t plane_id, int axis) {
  const FilterPlane& plane = space_.plane(plane_id).filter;
  const SolidEdge* edges = operands_[o]->edges_of(faces_[o]);
  const double r = space_.rounding();
  low_[o] = std::numeric_limits<double>::max();
  high_[o] = -low_[o];
  if (face(o).edge_count == 0) std::swap(low_[o], high_[o]);
  for (Hit& hit : hits_[o]) {
    const Vertex& p = space_.vertex(edges[hit.edge].from).approximate;
    const Vertex& q = space_.vertex(edges[hit.edge].to).approximate;
    hit.low = std::numeric_limits<double>::max();
    hit.high = -hit.low;
    const auto reach = [&](const Vertex& v) {
      hit.low = std::min(hit.low, coordinate(v, axis) - v.error);
      hit.high = std::max(hit.high, coordinate(v, axis) + v.error);
    };
    if (hit.from == 0) reach(p);
    if (hit.to == 0) reach(q);
    if (hit.from * hit.to < 0)
      reach(fast::meet(p, value_at(plane, p, r), q, value_at(plane, q, r), r));
    low_[o] = std::min(low_[o], hit.low);
    high_[o] = std::max(high_[o], hit.high);
  }
}

void Contact::begin_line() {
  marks_.clear();
  // What has no edges is everywhere.
  for (std::size_t o = 0; o < 2; ++o) {
    start_[o].fill(face(o).edge_count == 0);
    along_[o].clear();
    is_along_[o].forget();
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
    start_[o][0] = start_[o][0] != ((hit.from > 0) != (hit.to > 0));
    start_[o][1] = start_[o][1] != ((hit.from < 0) != (hit.to < 0));
  }
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
  mark.toggle[o] = {(hit.from > 0) != (hit.to > 0),
                    (hit.from < 0) != (hit.to < 0)};
  if (!mark.toggle[o][0] && !mark.toggle[o][1]) return;
  if (hit.from == 0) {
    mark.vertex = solid_edge.from;
  } else if (hit.to == 0) {
    mark.vertex = solid_edge.to;
  } else if (id < 0) {
    mark.vertex = space_.meet(
        face(o).plane, plane_athwart(solid_edge, face(o), space_), across);
  } else {
    LineEdge& edge = operand.edge(id);
    mark.edge[o] = id;
    mark.vertex =
        space_.meet(edge.plane, second_plane(edge, operand, space_), across);
  }
  marks_.push_back(mark);
}

/// Puts the marks in order along the axis, and makes one of those at the same
/// point.
void Contact::order_marks() {
  std::sort(marks_.begin(), marks_.end(), [&](const Mark& x, const Mark& y) {
    return space_.compare(axis_, x.vertex, y.vertex) < 0;
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
          return space_.compare(axis_, mark.vertex, vertex) < 0;
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
    const Mark& m = marks_[i];
    if (m.after[0][0] && m.after[0][1] && m.after[1][0] && m.after[1][1] &&
        !m.along[0] && !m.along[1]) {
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
          space_.cross_sign(edge.axis, face(o).plane, face(1 - o).plane) > 0);
    }
  }
}

/// Both faces lie in one plane: the edges of face `o` against the other face.
void Contact::meet_in_plane(std::size_t o) {
  Operand& operand = *operands_[o];
  const Box& other = face(1 - o).box;
  const auto blocks = blocks_of(o);
  const SolidEdge* edges = operand.edges_of(faces_[o]);
  for (std::uint32_t i = 0; i < face(o).edge_count; ++i) {
    if (!blocks.empty() && i % kBlock == 0 &&
        !overlap(blocks[i / kBlock], other)) {
      i += kBlock - 1;
      continue;
    }
    const std::uint32_t at = face(o).first_edge + i;
    const std::int32_t id = operand.edge_of[at];
    if (id < 0 || operand.edge(id).first_edge != at ||
        is_beyond(other, space_.vertex(edges[i].from).approximate,
                  space_.vertex(edges[i].to).approximate))
      continue;
    meet_edge(o, id);
  }
}

void Contact::meet_edge(std::size_t o, std::int32_t id) {
  Operand& operand = *operands_[o];
  const std::size_t p = 1 - o;
  const std::int32_t across = second_plane(operand.edge(id), operand, space_);
  if (!find_hits(p, across)) return;
  const LineEdge edge = operand.edge(id);
  measure(p, across, edge.axis);
  const Vertex& low = space_.vertex(edge.low).approximate;
  const Vertex& high = space_.vertex(edge.high).approximate;
  low_[o] = coordinate(low, edge.axis) - low.error;
  high_[o] = coordinate(high, edge.axis) + high.error;
  if (low_[0] > high_[1] || low_[1] > high_[0]) return;
  begin_line();
  add_marks(p, across);
  along_[o].push_back(id);
  for (const std::int32_t end : {edge.low, edge.high}) {
    Mark mark;
    mark.vertex = end;
    mark.present[o] = true;
    marks_.push_back(mark);
  }
  axis_ = edge.axis;
  order_marks();
  for (const Mark& mark : marks_) {
    if (mark.present[o] && mark.has(p)) put_on_other(o, mark.vertex);
  }
  report_along(o, id, space_.cross_sign(edge.axis, across, face(p).plane) > 0);
}

/// The points at which either face meets the other.
void Contact::report_cuts() {
  State before = start_;
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
  const auto [first, last] = marks_at(edge);
  const bool reversed = marks_[first].vertex == edge.high;
  for (std::size_t i = first; i < last; ++i) {
    const Mark& mark = marks_[i];
    if (i > first && mark.has(p)) cut(o, id, mark.vertex, /*through=*/false);
    if (!mark.after[p][0] && !mark.after[p][1]) continue;
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
