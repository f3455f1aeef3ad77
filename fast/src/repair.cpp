#include "halfspace/fast/repair.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "boolean_result.hpp"
#include "boolean_wings.hpp"
#include "self_contacts.hpp"

namespace halfspace::fast {
namespace {

/// Parts a surface along all lines on which its faces meet, and keeps what has
/// winding number 0 on one side and 1 or more on the other.
///
/// As in a boolean, every segment's surroundings tell which faces of the
/// result have an edge there: but how often the surface winds round the wedges
/// between its wings is counted from outside.
class Resolver {
 public:
  explicit Resolver(const Solid& solid)
      : solid_(solid),
        space_(*solid.space),
        contacts_(self_contacts(solid)),
        operand_(contacts_.operand),
        locator_(operand_, space_) {
    index_.add(solid, 0);
    std::sort(operand_.cuts.begin(), operand_.cuts.end(),
              [](const Cut& x, const Cut& y) { return x.edge < y.edge; });
  }

  Repaired run() {
    Repaired repaired;
    repaired.crossings = crossings_of(contacts_);
    mark_cut_faces();
    for (std::size_t e = 0; e < operand_.edges.size(); ++e) emit_edge(e);
    for (const Trace& trace : contacts_.traces) {
      if (trace.first < trace.second) emit_trace(trace);
    }
    repaired.solid = result(repaired);
    return repaired;
  }

 private:
  const Face& face(std::int32_t f) const { return operand_.face(f); }
  bool is_cut(std::int32_t f) const {
    return is_cut_[static_cast<std::size_t>(f)] != 0;
  }

  void mark_cut_faces();
  void emit_edge(std::size_t e);
  void emit_trace(const Trace& trace);
  void emit_segments(Segment line);
  void emit(const Segment& segment);
  void find_wings(const Segment& segment);
  void add_wings(std::int32_t f, const Segment& segment);
  int level_before_first(const Segment& segment) const;
  void add_points_of(std::int32_t f, const Trace& trace);
  bool stays(std::int32_t f);
  std::vector<std::int32_t> untouched_parts() const;
  Solid result(Repaired& repaired);

  const Solid& solid_;
  Space& space_;
  SelfContacts contacts_;
  Operand& operand_;
  Locator locator_;
  FaceIndex index_;
  std::vector<std::uint8_t> is_cut_;  ///< by face: something crosses it
  std::vector<std::int32_t> points_;
  std::vector<Wing> wings_;
  std::set<std::pair<std::int32_t, std::int32_t>> done_;  ///< segments
  std::vector<Piece> pieces_;
};

/// What meets another face but at vertices and edges that both have is cut.
void Resolver::mark_cut_faces() {
  is_cut_.assign(solid_.faces.size(), 0);
  const auto mark = [this](std::int32_t f) {
    is_cut_[static_cast<std::size_t>(f)] = 1;
  };
  const auto mark_uses = [&](const LineEdge& edge) {
    for (std::uint32_t u = 0; u < edge.use_count; ++u)
      mark(operand_.uses[edge.first_use + u].face);
  };
  for (const Trace& trace : contacts_.traces) {
    mark(trace.first);
    mark(trace.second);
  }
  for (const Cut& cut : operand_.cuts) {
    const LineEdge& edge = operand_.edge(cut.edge);
    if (cut.vertex == edge.low || cut.vertex == edge.high) continue;
    mark_uses(edge);
    mark(cut.face);
  }
  for (const Cover& cover : operand_.covers) {
    const LineEdge& edge = operand_.edge(cover.edge);
    bool is_own = false;
    for (std::uint32_t u = 0; u < edge.use_count; ++u)
      is_own = is_own || operand_.uses[edge.first_use + u].face == cover.face;
    if (is_own) continue;
    mark_uses(edge);
    mark(cover.face);
  }
  // Faces in one plane that have all edges in common.
  for (const Crossing& crossing : crossings_of(contacts_)) {
    mark(crossing.first);
    mark(crossing.second);
  }
}

void Resolver::emit_edge(std::size_t e) {
  const auto id = static_cast<std::int32_t>(e);
  bool any = false;
  LineEdge& edge = operand_.edge(id);
  for (std::uint32_t u = 0; u < edge.use_count; ++u)
    any = any || is_cut(operand_.uses[edge.first_use + u].face);
  if (!any) return;
  points_.clear();
  const auto first = std::lower_bound(
      operand_.cuts.begin(), operand_.cuts.end(), id,
      [](const Cut& cut, std::int32_t key) { return cut.edge < key; });
  for (auto cut = first; cut != operand_.cuts.end() && cut->edge == id; ++cut)
    points_.push_back(cut->vertex);
  const std::int32_t other = second_plane(edge, operand_, space_);
  emit_segments({edge.low, edge.high, edge.axis, {edge.plane, other}});
}

/// A segment in two faces' interiors. Where the plane of a third one crosses
/// it, or an edge ends on it, it is parted.
void Resolver::emit_trace(const Trace& trace) {
  points_.clear();
  Box box = kEmptyBox;
  extend(box, space_.vertex(trace.low).approximate);
  extend(box, space_.vertex(trace.high).approximate);
  std::vector<std::int32_t> near;
  index_.find(box, [&](std::int32_t f) { near.push_back(f); });
  for (const std::int32_t f : near) {
    if (f != trace.first && f != trace.second) add_points_of(f, trace);
  }
  emit_segments({trace.low,
                 trace.high,
                 trace.axis,
                 {face(trace.first).plane, face(trace.second).plane}});
}

void Resolver::add_points_of(std::int32_t f, const Trace& trace) {
  const std::int32_t first = face(trace.first).plane;
  const std::int32_t second = face(trace.second).plane;
  const int low = space_.side(face(f).plane, trace.low);
  const int high = space_.side(face(f).plane, trace.high);
  if (low * high < 0)
    points_.push_back(space_.meet(first, second, face(f).plane));
  if (low != 0 || high != 0) return;
  const auto add = [&](std::int32_t v) {
    if (space_.side(first, v) == 0 && space_.side(second, v) == 0 &&
        space_.compare(trace.axis, v, trace.low) > 0 &&
        space_.compare(trace.axis, v, trace.high) < 0)
      points_.push_back(v);
  };
  for (std::uint32_t i = 0; i < face(f).edge_count; ++i) {
    const std::uint32_t at = face(f).first_edge + i;
    add(solid_.edges[at].from);
    const std::int32_t id = operand_.edge_of[at];
    auto cut = std::lower_bound(
        operand_.cuts.begin(), operand_.cuts.end(), id,
        [](const Cut& c, std::int32_t key) { return c.edge < key; });
    for (; cut != operand_.cuts.end() && cut->edge == id; ++cut)
      add(cut->vertex);
  }
}

/// The line's segments between the points.
void Resolver::emit_segments(Segment line) {
  points_.push_back(line.low);
  points_.push_back(line.high);
  std::sort(points_.begin(), points_.end());
  points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  std::sort(points_.begin(), points_.end(),
            [&](std::int32_t u, std::int32_t v) {
              return space_.compare(line.axis, u, v) < 0;
            });
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    line.low = points_[i];
    line.high = points_[i + 1];
    // Edges and traces may share a segment.
    if (done_.insert(std::minmax(line.low, line.high)).second) emit(line);
  }
}

/// The faces that have the segment in them or along an edge.
void Resolver::find_wings(const Segment& segment) {
  wings_.clear();
  Box box = kEmptyBox;
  extend(box, space_.vertex(segment.low).approximate);
  extend(box, space_.vertex(segment.high).approximate);
  std::vector<std::int32_t> near;
  index_.find(box, [&](std::int32_t f) {
    if (space_.side(face(f).plane, segment.low) == 0 &&
        space_.side(face(f).plane, segment.high) == 0)
      near.push_back(f);
  });
  std::sort(near.begin(), near.end());
  for (const std::int32_t f : near) add_wings(f, segment);
}

/// Seen from right beside the line, on either side, the face begins and ends
/// where its edges cross that side.
void Resolver::add_wings(std::int32_t f, const Segment& segment) {
  const Face& of = face(f);
  const std::int32_t across = other_than(of.plane, segment.planes);
  bool positive = false, negative = false;
  for (std::uint32_t i = 0; i < of.edge_count; ++i) {
    const SolidEdge& edge = solid_.edges[of.first_edge + i];
    const int from = space_.side(across, edge.from);
    const int to = space_.side(across, edge.to);
    const bool on_positive = (from > 0) != (to > 0);
    const bool on_negative = (from < 0) != (to < 0);
    if (!on_positive && !on_negative) continue;
    const std::int32_t at =
        from == 0 ? edge.from
        : to == 0
            ? edge.to
            : space_.meet(of.plane, plane_athwart(edge, of, space_), across);
    if (space_.compare(segment.axis, at, segment.low) > 0) continue;
    positive = positive != on_positive;
    negative = negative != on_negative;
  }
  const bool positive_is_left =
      space_.cross_sign(segment.axis, across, of.plane) > 0;
  if (positive_is_left ? positive : negative)
    wings_.push_back({0, f, of.plane, 1, of.turned});
  if (positive_is_left ? negative : positive)
    wings_.push_back({0, f, of.plane, -1, of.turned});
}

/// How often the surface winds round the wedge before the first wing.
///
/// The locator tells of the wedge that holds a point beside the segment, in a
/// direction D that has a sign against every plane. The angle from a wing to D
/// has a sine of that sign, times the wing's turn.
int Resolver::level_before_first(const Segment& segment) const {
  const auto sine = [this](const Wing& w) {
    for (const int axis : {0, 2, 1}) {
      const int sign = space_.normal_sign(w.plane, axis);
      if (sign != 0) return sign * w.turn;
    }
    return 0;
  };
  int level = locator_.winding(segment.low, segment.high);
  const Wing& first = wings_.front();
  const bool within_half = sine(first) > 0;
  for (const Wing& w : wings_) {
    const int part = part_of_turn(first, w, segment.axis, space_);
    const int doubtful = within_half ? 1 : 3;
    if (part < doubtful || (part == doubtful && sine(w) > 0))
      level -= change(w);
  }
  return level;
}

void Resolver::emit(const Segment& segment) {
  find_wings(segment);
  if (wings_.empty()) return;
  sort_wings(wings_, segment.axis, space_);
  int level = level_before_first(segment);
  const std::size_t before_any = pieces_.size();
  for (std::size_t i = 0; i < wings_.size();) {
    const bool before = level > 0;
    const std::size_t first = i;
    do {
      level += change(wings_[i]);
      ++i;
    } while (i < wings_.size() && as_last(wings_, i));
    const bool after = level > 0;
    if (before == after) continue;
    // One of the wings looks outwards there, where the result ends or begins.
    std::size_t source = first;
    while (change(wings_[source]) != (before ? -1 : 1)) ++source;
    const Wing& wing = wings_[source];
    Piece piece{wing.face, wing.plane, segment.low, segment.high,
                other_than(wing.plane, segment.planes)};
    if (!before) std::swap(piece.from, piece.to);
    pieces_.push_back(piece);
  }
  // A face that goes on beyond the segment has no edge there.
  if (pieces_.size() == before_any + 2 &&
      pieces_[before_any].bucket == pieces_[before_any + 1].bucket)
    pieces_.resize(before_any);
}

/// Whether a face that nothing cuts bounds the result.
bool Resolver::stays(std::int32_t f) {
  const LineEdge& of = operand_.edge(operand_.edge_of[face(f).first_edge]);
  LineEdge edge = of;
  const Segment segment{edge.low,
                        edge.high,
                        edge.axis,
                        {edge.plane, second_plane(edge, operand_, space_)}};
  find_wings(segment);
  sort_wings(wings_, segment.axis, space_);
  int level = level_before_first(segment);
  for (std::size_t i = 0; i < wings_.size(); ++i) {
    const bool before = level > 0;
    level += change(wings_[i]);
    if (wings_[i].face == f) return before != (level > 0);
  }
  return false;
}

/// For each face that nothing cuts, one that stays if it does: of two at an
/// edge that no others have.
std::vector<std::int32_t> Resolver::untouched_parts() const {
  std::vector<std::int32_t> parent(solid_.faces.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t f) {
    while (parent[static_cast<std::size_t>(f)] != f) {
      std::int32_t& up = parent[static_cast<std::size_t>(f)];
      up = parent[static_cast<std::size_t>(up)];
      f = up;
    }
    return f;
  };
  for (const LineEdge& edge : operand_.edges) {
    if (edge.use_count != 2) continue;
    const std::int32_t f = operand_.uses[edge.first_use].face;
    const std::int32_t g = operand_.uses[edge.first_use + 1].face;
    if (is_cut(f) || is_cut(g)) continue;
    const std::int32_t r = root(f);
    const std::int32_t s = root(g);
    parent[static_cast<std::size_t>(std::max(r, s))] = std::min(r, s);
  }
  for (std::size_t f = 0; f < parent.size(); ++f)
    parent[f] = root(static_cast<std::int32_t>(f));
  return parent;
}

Solid Resolver::result(Repaired& repaired) {
  Solid result{{}, {}, false, solid_.unit, solid_.space};
  // Step 1: the faces that nothing cuts, as they are.
  const std::vector<std::int32_t> part = untouched_parts();
  std::vector<std::uint8_t> stay(solid_.faces.size());
  std::set<std::int32_t> pinned;
  const auto begin = [&](std::int32_t f) {
    result.faces.push_back(face(f));
    Face& last = result.faces.back();
    last.from_first = true;
    last.source = f;
    last.first_edge = static_cast<std::uint32_t>(result.edges.size());
    last.edge_count = 0;
  };
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(part.size()); ++f) {
    if (is_cut(f)) continue;
    const auto at = static_cast<std::size_t>(f);
    stay[at] = part[at] == f ? stays(f)
                             : stay[static_cast<std::size_t>(part[at])] != 0;
    if (stay[at] == 0) continue;
    begin(f);
    result.faces.back().edge_count = face(f).edge_count;
    for (std::uint32_t i = 0; i < face(f).edge_count; ++i) {
      result.edges.push_back(solid_.edges[face(f).first_edge + i]);
      pinned.insert(result.edges.back().from);
    }
  }
  // Step 2: what is left of the others.
  std::erase_if(pieces_, [&](const Piece& piece) {
    return !is_cut(static_cast<std::int32_t>(piece.bucket));
  });
  straighten(
      pieces_, [&](std::int32_t v) { return pinned.count(v) != 0; }, space_);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto f = static_cast<std::int32_t>(pieces_[i].bucket);
    if (i == 0 || pieces_[i - 1].bucket != pieces_[i].bucket) {
      begin(f);
      ++repaired.faces_cut;
    }
    result.edges.push_back({pieces_[i].from, pieces_[i].to, pieces_[i].other});
    ++result.faces.back().edge_count;
  }
  for (Face& of : result.faces) of.box = face_box(result, of);
  repaired.faces_dropped = solid_.faces.size() - result.faces.size();
  return result;
}

}  // namespace

Repaired repair(const Solid& solid) { return Resolver(solid).run(); }

}  // namespace halfspace::fast
