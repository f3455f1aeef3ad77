#include "boolean/resolve.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "intersect/self_intersections.hpp"
#include "intersect/self_radial_order.hpp"
#include "intersect/transversal_plane.hpp"
#include "solid/loops.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

/// Cuts a surface along all segments on which its faces meet, and keeps what
/// has winding number 0 or less in front and 1 or more behind (S6.7).
///
/// As in a boolean, the half-faces round every segment decide which faces of
/// the result have an edge there; here the wedges between them carry winding
/// numbers.
class Resolver {
 public:
  Resolver(const Solid& solid, TableLease& lease,
           const RestOfSurface* rest = nullptr)
      : solid_(solid),
        rest_(rest),
        table_(lease.table()),
        half_faces_(solid, lease),
        contacts_(half_faces_.contacts()),
        operand_(contacts_.operand) {
    if (rest != nullptr) half_faces_.set_rest(rest->winding);
    std::sort(operand_.cuts.begin(), operand_.cuts.end(),
              [](const EdgeFaceIntersection& x, const EdgeFaceIntersection& y) {
                return x.edge < y.edge;
              });
  }

  Resolved run() {
    Resolved resolved;
    resolved.self_intersections = self_intersections_of(contacts_);
    mark_cut_faces();
    for (std::size_t e = 0; e < operand_.edges.size(); ++e) emit_edge(e);
    for (const IntersectionSegment& trace : contacts_.segments) {
      if (trace.first < trace.second) emit_intersection_segment(trace);
    }
    resolved.solid = result(resolved);
    return resolved;
  }

 private:
  const Face& face(std::int32_t f) const { return operand_.face(f); }
  bool is_cut(std::int32_t f) const {
    return is_cut_[static_cast<std::size_t>(f)] != 0;
  }
  bool is_known(std::int32_t f) const {
    return rest_ != nullptr && rest_->stays[static_cast<std::size_t>(f)] >= 0;
  }

  void mark_cut_faces();
  void emit_edge(std::size_t e);
  void emit_intersection_segment(const IntersectionSegment& trace);
  void emit_segments(Segment line);
  void emit(const Segment& segment);
  void add_points(const Segment& line);
  void add_points_of(std::int32_t f, const Segment& line);
  bool is_in_extent(std::int32_t f, std::int32_t v) const;
  std::vector<std::uint8_t> faces_that_stay();
  Solid result(Resolved& resolved);

  const Solid& solid_;
  const RestOfSurface* rest_;  ///< null: the solid is all of the surface
  GeometryTable& table_;
  SelfRadialOrder half_faces_;
  SelfContacts& contacts_;
  Operand& operand_;
  std::vector<std::uint8_t> is_cut_;  ///< by face: something crosses it
  std::vector<std::int32_t> points_;
  std::set<std::pair<std::int32_t, std::int32_t>> done_;  ///< segments
  List<DirectedEdge> pieces_;
};

/// Marks faces that meet another one elsewhere than in shared vertices and
/// edges.
void Resolver::mark_cut_faces() {
  is_cut_.assign(solid_.faces.size(), 0);
  const auto mark = [this](std::int32_t f) {
    is_cut_[static_cast<std::size_t>(f)] = 1;
  };
  const auto mark_uses = [&](const OperandEdge& edge) {
    for (std::uint32_t u = 0; u < edge.use_count; ++u)
      mark(operand_.uses[edge.first_use + u].face);
  };
  for (const IntersectionSegment& trace : contacts_.segments) {
    mark(trace.first);
    mark(trace.second);
  }
  for (const EdgeFaceIntersection& cut : operand_.cuts) {
    const OperandEdge& edge = operand_.edge(cut.edge);
    if (cut.vertex == edge.low || cut.vertex == edge.high) continue;
    mark_uses(edge);
    mark(cut.face);
  }
  for (const EdgeInFace& cover : operand_.covers) {
    const OperandEdge& edge = operand_.edge(cover.edge);
    bool is_own = false;
    for (std::uint32_t u = 0; u < edge.use_count; ++u)
      is_own = is_own || operand_.uses[edge.first_use + u].face == cover.face;
    if (is_own) continue;
    mark_uses(edge);
    mark(cover.face);
  }
  // Faces in one plane that have all edges in common.
  for (const SelfIntersection& crossing : self_intersections_of(contacts_)) {
    mark(crossing.first);
    mark(crossing.second);
  }
  // The surface may pass through itself along their edges; all of such a face
  // stays or goes, then.
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(is_cut_.size()); ++f) {
    if (is_known(f)) is_cut_[static_cast<std::size_t>(f)] = 0;
  }
}

void Resolver::emit_edge(std::size_t e) {
  const auto id = static_cast<std::int32_t>(e);
  bool any = false;
  OperandEdge& edge = operand_.edge(id);
  for (std::uint32_t u = 0; u < edge.use_count; ++u)
    any = any || is_cut(operand_.uses[edge.first_use + u].face);
  if (!any) return;
  points_.clear();
  const std::int32_t other = transversal_plane(edge, table_);
  const Segment line{edge.low, edge.high, edge.axis, {edge.plane, other}};
  add_points(line);
  emit_segments(line);
}

/// A segment in two faces' interiors.
void Resolver::emit_intersection_segment(const IntersectionSegment& trace) {
  points_.clear();
  const Segment line{trace.low,
                     trace.high,
                     trace.axis,
                     {face(trace.first).plane, face(trace.second).plane}};
  add_points(line);
  emit_segments(line);
}

/// Where another face may cross the line, or has a point on it. Edges and
/// segments that have a part in common are parted there at the same points, for
/// they are a matter of the point and one face.
void Resolver::add_points(const Segment& line) {
  Box box = kEmptyBox;
  extend(box, table_.vertex(line.low).approximate);
  extend(box, table_.vertex(line.high).approximate);
  std::vector<std::int32_t> near;
  half_faces_.index().find(box, [&](std::int32_t f) { near.push_back(f); });
  for (const std::int32_t f : near) add_points_of(f, line);
}

/// Whether the point is between the face's vertices along every axis.
bool Resolver::is_in_extent(std::int32_t f, std::int32_t v) const {
  for (const int axis : {0, 1, 2}) {
    bool below = false, above = false;
    for (std::uint32_t i = 0; i < face(f).edge_count; ++i) {
      const std::int32_t u = solid_.edges[face(f).first_edge + i].from;
      const int sign = table_.compare(axis, u, v);
      below = below || sign <= 0;
      above = above || sign >= 0;
      if (below && above) break;
    }
    if (!below || !above) return false;
  }
  return true;
}

void Resolver::add_points_of(std::int32_t f, const Segment& line) {
  const auto [first, second] = line.planes;
  const int low = table_.side(face(f).plane, line.low);
  const int high = table_.side(face(f).plane, line.high);
  if (low * high < 0) {
    const std::int32_t v = table_.meet(first, second, face(f).plane);
    if (is_in_extent(f, v)) points_.push_back(v);
  }
  if (low != 0 || high != 0) return;
  const auto add = [&](std::int32_t v) {
    if (table_.side(line.planes[0], v) == 0 &&
        table_.side(line.planes[1], v) == 0 &&
        table_.compare(line.axis, v, line.low) > 0 &&
        table_.compare(line.axis, v, line.high) < 0)
      points_.push_back(v);
  };
  for (std::uint32_t i = 0; i < face(f).edge_count; ++i) {
    const std::uint32_t at = face(f).first_edge + i;
    add(solid_.edges[at].from);
    const std::int32_t id = operand_.edge_of[at];
    auto cut = std::lower_bound(operand_.cuts.begin(), operand_.cuts.end(), id,
                                [](const EdgeFaceIntersection& c,
                                   std::int32_t key) { return c.edge < key; });
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
              return table_.compare(line.axis, u, v) < 0;
            });
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    line.low = points_[i];
    line.high = points_[i + 1];
    // Edges and segments may share a segment.
    if (done_.insert(std::minmax(line.low, line.high)).second) emit(line);
  }
}

void Resolver::emit(const Segment& segment) {
  const std::vector<HalfFace>& half_faces = half_faces_.at(segment);
  if (half_faces.empty()) return;
  int winding = half_faces_.winding_before_first(segment);
  const std::size_t before_any = pieces_.size();
  for (std::size_t i = 0; i < half_faces.size();) {
    const bool before = winding > 0;
    const std::size_t first = i;
    do {
      winding += change(half_faces[i]);
      ++i;
    } while (i < half_faces.size() && as_last(half_faces, i));
    const bool after = winding > 0;
    if (before == after) continue;
    // One of the half-faces looks outwards there, where the result ends or
    // begins.
    std::size_t source = first;
    while (change(half_faces[source]) != (before ? -1 : 1)) ++source;
    const HalfFace& half_face = half_faces[source];
    DirectedEdge piece{half_face.face, half_face.plane, segment.low,
                       segment.high,
                       other_than(half_face.plane, segment.planes)};
    if (!before) std::swap(piece.from, piece.to);
    pieces_.push_back(piece);
  }
  // A face that goes on beyond the segment has no edge there.
  if (pieces_.size() == before_any + 2 &&
      pieces_[before_any].bucket == pieces_[before_any + 1].bucket)
    pieces_.resize(before_any);
}

/// Of the faces that nothing cuts, those with winding number 0 in front: all of
/// a part has the same.
std::vector<std::uint8_t> Resolver::faces_that_stay() {
  const std::vector<std::int32_t> part = parts_of_surface(operand_, is_cut_);
  std::vector<std::uint8_t> stay(solid_.faces.size());
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(part.size()); ++f) {
    if (is_cut(f)) continue;
    const auto at = static_cast<std::size_t>(f);
    if (is_known(f)) {
      stay[at] = rest_->stays[at] != 0;
    } else {
      stay[at] = part[at] == f ? half_faces_.winding_outside(f) == 0
                               : stay[static_cast<std::size_t>(part[at])] != 0;
    }
  }
  return stay;
}

Solid Resolver::result(Resolved& resolved) {
  Solid result{{}, {}, false, solid_.unit, solid_.table, true};
  // Step 1: the faces that nothing cuts, as they are.
  const std::vector<std::uint8_t> stay = faces_that_stay();
  std::set<std::int32_t> pinned;
  const auto begin = [&](std::int32_t f) {
    result.faces.push_back(face(f));
    Face& last = result.faces.back();
    last.from_first = true;
    last.source = f;
    last.first_edge = static_cast<std::uint32_t>(result.edges.size());
    last.edge_count = 0;
  };
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(stay.size()); ++f) {
    if (stay[static_cast<std::size_t>(f)] == 0) continue;
    begin(f);
    result.faces.back().edge_count = face(f).edge_count;
    for (std::uint32_t i = 0; i < face(f).edge_count; ++i) {
      result.edges.push_back(solid_.edges[face(f).first_edge + i]);
      pinned.insert(result.edges.back().from);
    }
  }
  // Step 2: what is left of the others.
  std::erase_if(pieces_, [&](const DirectedEdge& piece) {
    return !is_cut(static_cast<std::int32_t>(piece.bucket));
  });
  drop_collinear_vertices(
      pieces_, [&](std::int32_t v) { return pinned.count(v) != 0; }, table_);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto f = static_cast<std::int32_t>(pieces_[i].bucket);
    if (i == 0 || pieces_[i - 1].bucket != pieces_[i].bucket) {
      begin(f);
      ++resolved.faces_cut;
    }
    result.edges.push_back({pieces_[i].from, pieces_[i].to, pieces_[i].other});
    ++result.faces.back().edge_count;
  }
  for (Face& of : result.faces) of.box = face_box(result, of);
  resolved.faces_dropped = solid_.faces.size() - result.faces.size();
  return result;
}

}  // namespace

Resolved resolved(const Solid& solid, TableLease& lease) {
  return Resolver(solid, lease).run();
}

Resolved resolved_patch(const Solid& patch, TableLease& lease,
                        const RestOfSurface& rest) {
  return Resolver(patch, lease, &rest).run();
}

Resolved resolve(const Solid& solid) { return with_lease(solid, resolved); }

}  // namespace halfspace::fast
