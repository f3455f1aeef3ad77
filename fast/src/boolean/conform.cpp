#include "boolean/conform.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "base/check.hpp"
#include "boolean/resolve.hpp"
#include "box/bvh.hpp"
#include "halfspace/fast/bad_edges.hpp"
#include "intersect/line_section.hpp"
#include "intersect/radial_order.hpp"
#include "intersect/transversal_plane.hpp"

namespace halfspace::fast {
namespace {

/// Whether no point of the surface is beyond the plane of any of its faces.
bool is_convex(const Solid& solid) {
  return std::all_of(
      solid.faces.begin(), solid.faces.end(), [&](const Face& face) {
        return std::all_of(
            solid.edges.begin(), solid.edges.end(), [&](const SolidEdge& edge) {
              const int side = solid.table->side(face.plane, edge.from);
              return face.flipped ? side >= 0 : side <= 0;
            });
      });
}

Box box_of(const GeometryTable& table, std::int32_t low, std::int32_t high) {
  Box box = kEmptyBox;
  extend(box, table.vertex(low).approximate);
  extend(box, table.vertex(high).approximate);
  return box;
}

/// Finds where an operand touches itself on the other one's surface.
class Conformer {
 public:
  Conformer(std::size_t o, std::array<Operand, 2>& operands,
            List<IntersectionSegment>& segments, GeometryTable& table)
      : o_(o),
        operand_(operands[o]),
        other_(operands[1 - o]),
        segments_(segments),
        table_(table),
        section_(table) {}

  bool run() {
    if (!operand_.covers.empty() && !cut_covered_edges()) return false;
    if (!segments_.empty()) split_segments();
    return true;
  }

 private:
  bool cut_covered_edges();
  void add_cuts();
  int side_of(std::int32_t face, std::int32_t vertex) const;
  std::span<const SolidEdge> edges_near(std::int32_t face, std::int32_t plane);
  bool add_points(std::int32_t edge, std::int32_t face);
  void split_segments();
  void find_cuts_on_segments();
  void find_vertices_on_segments();
  void find_on_segment(std::size_t segment, std::int32_t vertex);
  void find_on_any_segment(std::int32_t vertex);
  std::int32_t own_face(const IntersectionSegment& segment) const {
    return o_ == 0 ? segment.first : segment.second;
  }
  std::int32_t other_face(const IntersectionSegment& segment) const {
    return o_ == 0 ? segment.second : segment.first;
  }
  bool is_between(int axis, std::int32_t low, std::int32_t v,
                  std::int32_t high) const {
    return table_.compare(axis, low, v) < 0 &&
           table_.compare(axis, v, high) < 0;
  }

  std::size_t o_;
  Operand& operand_;
  const Operand& other_;
  List<IntersectionSegment>& segments_;
  GeometryTable& table_;
  LineFaceSection section_;
  std::vector<SolidEdge> near_edges_;  ///< of the current face
  /// Covered edges and points within them.
  std::vector<std::pair<std::int32_t, std::int32_t>> points_;
  std::optional<BoxTree> segment_bvh_;
  /// Traces and points within them.
  std::vector<std::pair<std::size_t, std::int32_t>> nodes_;
};

/// False: there is an edge of which a part lies in a face that has it not.
bool Conformer::cut_covered_edges() {
  const BoxTree tree(
      [&](std::int32_t f) -> const Box& { return operand_.face(f).box; },
      operand_.active);
  std::vector<std::uint8_t> is_done(operand_.edges.size());
  for (const EdgeInFace& cover : operand_.covers) {
    std::uint8_t& done = is_done[static_cast<std::size_t>(cover.edge)];
    if (done != 0) continue;
    done = 1;
    const OperandEdge& edge = operand_.edge(cover.edge);
    bool is_alone = true;
    tree.find(box_of(table_, edge.low, edge.high), [&](std::int32_t f) {
      is_alone = is_alone && add_points(cover.edge, f);
    });
    if (!is_alone) return false;
  }
  if (!points_.empty()) add_cuts();
  return true;
}

/// Cuts the edges at the points, where they are covered.
void Conformer::add_cuts() {
  List<EdgeFaceIntersection>& cuts = operand_.cuts;
  std::sort(points_.begin(), points_.end());
  for (const EdgeInFace& cover : operand_.covers) {
    const int axis = operand_.edge(cover.edge).axis;
    auto point = std::lower_bound(
        points_.begin(), points_.end(), cover.edge,
        [](const auto& p, std::int32_t edge) { return p.first < edge; });
    for (; point != points_.end() && point->first == cover.edge; ++point) {
      if (is_between(axis, cover.low, point->second, cover.high))
        cuts.push_back({cover.edge, point->second, cover.face});
    }
  }
  // Some were known.
  const auto key = [](const EdgeFaceIntersection& cut) {
    return std::tie(cut.edge, cut.vertex, cut.face);
  };
  std::sort(cuts.begin(), cuts.end(),
            [&](const EdgeFaceIntersection& x, const EdgeFaceIntersection& y) {
              return key(x) < key(y);
            });
  cuts.erase(std::unique(cuts.begin(), cuts.end(),
                         [&](const EdgeFaceIntersection& x,
                             const EdgeFaceIntersection& y) {
                           return key(x) == key(y);
                         }),
             cuts.end());
}

/// On which side of a face's plane the vertex is. Most are asked of the faces
/// around them.
int Conformer::side_of(std::int32_t f, std::int32_t vertex) const {
  constexpr std::uint32_t kFew = 8;
  const Face& face = operand_.face(f);
  const SolidEdge* edges = operand_.edges_of(f);
  for (std::uint32_t i = 0; i < std::min(face.edge_count, kFew); ++i) {
    if (edges[i].from == vertex) return 0;
  }
  return table_.side(face.plane, vertex);
}

/// Those edges of a face that may meet a plane, in their order.
std::span<const SolidEdge> Conformer::edges_near(std::int32_t f,
                                                 std::int32_t plane) {
  const SolidEdge* edges = operand_.edges_of(f);
  const PacketList* list = operand_.blocks->of(f);
  if (list == nullptr) return {edges, operand_.face(f).edge_count};
  near_edges_.clear();
  list->visit(
      [&](const Box& box) {
        return filtered_side(table_.plane(plane).filter, box,
                             table_.rounding()) == 0;
      },
      [&](const EdgePacket& block) {
        near_edges_.insert(near_edges_.end(), edges + block.first,
                           edges + block.first + block.count);
      });
  return near_edges_;
}

/// Adds the points within an edge at which a face that has it not touches it.
/// False if it has more of the edge in it than points.
bool Conformer::add_points(std::int32_t id, std::int32_t f) {
  OperandEdge& edge = operand_.edge(id);
  for (std::uint32_t u = 0; u < edge.use_count; ++u) {
    if (operand_.uses[edge.first_use + u].face == f) return true;
  }
  const Face& face = operand_.face(f);
  const int low = side_of(f, edge.low);
  const int high = side_of(f, edge.high);
  // At an end there is a vertex of the edge.
  if (low * high > 0 || (low == 0) != (high == 0)) return true;
  const std::array<std::int32_t, 2> planes{edge.plane,
                                           transversal_plane(edge, table_)};
  const std::int32_t across = other_than(face.plane, planes);
  const auto edges = edges_near(f, across);
  if (low != 0) {
    const std::int32_t at = table_.meet(planes[0], planes[1], face.plane);
    HALFSPACE_CHECK(is_between(edge.axis, edge.low, at, edge.high));
    HALFSPACE_CHECK(across != face.plane);
    int axis = 0;
    table_.line_axis(face.plane, across, axis);
    section_.find(face, edges, across, axis);
    for (const auto& [from, to] : section_.parts()) {
      if (from == at || is_between(axis, from, at, to)) {
        points_.emplace_back(id, at);
        break;
      }
    }
    return true;
  }
  // Where it has just a point of the edge, another face there crosses it.
  section_.find(face, edges, across, edge.axis);
  return std::none_of(
      section_.parts().begin(), section_.parts().end(), [&](const auto& part) {
        const auto& [from, to] = part;
        return from != to && table_.compare(edge.axis, from, edge.high) < 0 &&
               table_.compare(edge.axis, edge.low, to) < 0;
      });
}

/// Within a segment neither of its faces has a vertex.
void Conformer::split_segments() {
  find_cuts_on_segments();
  find_vertices_on_segments();
  std::sort(nodes_.begin(), nodes_.end(), [&](const auto& x, const auto& y) {
    if (x.first != y.first) return x.first < y.first;
    return table_.compare(segments_[x.first].axis, x.second, y.second) < 0;
  });
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  for (const auto& [t, vertex] : nodes_) {
    // The part up to the point stands aside, what is left here.
    IntersectionSegment part = segments_[t];
    HALFSPACE_CHECK(is_between(part.axis, part.low, vertex, part.high));
    part.high = vertex;
    segments_[t].low = vertex;
    segments_.push_back(part);
  }
}

/// If the point is within the segment, notes that.
void Conformer::find_on_segment(std::size_t t, std::int32_t vertex) {
  const IntersectionSegment& segment = segments_[t];
  if (vertex == segment.low || vertex == segment.high) return;
  if (is_between(segment.axis, segment.low, vertex, segment.high) &&
      table_.side(operand_.face(own_face(segment)).plane, vertex) == 0 &&
      table_.side(other_.face(other_face(segment)).plane, vertex) == 0)
    nodes_.emplace_back(t, vertex);
}

void Conformer::find_on_any_segment(std::int32_t vertex) {
  if (!segment_bvh_) {
    std::vector<Box> boxes;
    for (const IntersectionSegment& segment : segments_)
      boxes.push_back(box_of(table_, segment.low, segment.high));
    std::vector<std::int32_t> items(boxes.size());
    std::iota(items.begin(), items.end(), 0);
    segment_bvh_.emplace(
        [&](std::int32_t t) { return boxes[static_cast<std::size_t>(t)]; },
        items);
  }
  segment_bvh_->find(box_of(table_, vertex, vertex), [&](std::int32_t t) {
    find_on_segment(static_cast<std::size_t>(t), vertex);
  });
}

/// Where edges meet the other operand's faces, those may have segments.
void Conformer::find_cuts_on_segments() {
  if (operand_.cuts.empty()) return;
  // Step 1: the segments by the other operand's faces.
  std::vector<std::uint32_t> first(other_.solid->faces.size() + 1);
  const auto count_of = [&](std::int32_t f) -> std::uint32_t& {
    return first[static_cast<std::size_t>(f) + 1];
  };
  for (const IntersectionSegment& segment : segments_)
    ++count_of(other_face(segment));
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> by_face(segments_.size());
  for (std::size_t t = segments_.size(); t-- > 0;) {
    by_face[--count_of(other_face(segments_[t]))] =
        static_cast<std::uint32_t>(t);
  }
  // Step 2: the points on each. Its segments begin now where those of the face
  // before it end.
  constexpr std::uint32_t kMany = 16;
  for (const EdgeFaceIntersection& cut : operand_.cuts) {
    const std::uint32_t begin = count_of(cut.face);
    const auto f = static_cast<std::size_t>(cut.face);
    const std::uint32_t end =
        f + 2 < first.size() ? first[f + 2]
                             : static_cast<std::uint32_t>(segments_.size());
    if (end - begin > kMany) {
      find_on_any_segment(cut.vertex);
      continue;
    }
    for (std::uint32_t i = begin; i < end; ++i)
      find_on_segment(by_face[i], cut.vertex);
  }
}

void Conformer::find_vertices_on_segments() {
  std::vector<std::int32_t> vertices;
  for (const OperandEdge& edge : operand_.edges) {
    for (const std::int32_t v : {edge.low, edge.high}) {
      if (operand_.is_on_other(v)) vertices.push_back(v);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const std::int32_t v : vertices) find_on_any_segment(v);
}

}  // namespace

bool is_known_conforming(const Solid& solid) {
  // Beyond so much it is sooner to look at what matters.
  constexpr std::size_t kMost = 2048;
  return solid.is_conforming ||
         (solid.faces.size() * solid.edges.size() <= kMost && is_convex(solid));
}

bool conform_contacts(std::size_t o, std::array<Operand, 2>& operands,
                      List<IntersectionSegment>& segments,
                      GeometryTable& table) {
  return Conformer(o, operands, segments, table).run();
}

Solid conforming(const Solid& solid, TableLease& lease) {
  const bool is_bounded_by_edges =
      std::none_of(solid.faces.begin(), solid.faces.end(),
                   [](const Face& face) { return face.edge_count == 0; });
  if (!is_bounded_by_edges || !bad_edges(solid).empty() ||
      !open_faces(solid).empty()) {
    Solid same = solid;
    same.is_conforming = true;
    return same;
  }
  return solid.unbounded ? complement(resolved(complement(solid), lease).solid)
                         : resolved(solid, lease).solid;
}

}  // namespace halfspace::fast
