#include "boolean/classify.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace halfspace::fast {
namespace {

PointLocator near_faces(const Operand& operand, const GeometryTable& table) {
  return {*operand.solid, table, nullptr, operand.blocks.get()};
}

}  // namespace

Classifier::Classifier(Arrangement& arrangement)
    : common_(arrangement),
      operands_(arrangement.operands),
      table_(arrangement.table),
      scratch_(arrangement.scratch),
      near_faces_{near_faces(operands_[0], table_),
                  near_faces(operands_[1], table_)} {
  for (std::size_t o = 0; o < 2; ++o) {
    join_vertices(o);
    note_members(o);
  }
}

std::int32_t Classifier::find_root(std::size_t o, std::int32_t vertex) {
  SparseDisjointSets& sets = scratch_.sets[o];
  if (sets.parents().get(vertex + 1, -1) < 0) {
    sets.attach(vertex + 1,
                common_.is_beyond_other(o, vertex) ? 0 : vertex + 1);
  }
  return sets.root(vertex + 1);
}

/// Whether a triangle's vertices are known to be joined: most are, by the
/// triangles beside it.
bool Classifier::is_joined(std::size_t o, const SolidEdge* edges) const {
  // A vertex of no set yet is its own parent, so different from the others'.
  const SparseParents& parents = scratch_.sets[o].parents();
  const std::int32_t up = parents.get(edges[0].from + 1);
  return up == parents.get(edges[1].from + 1) &&
         up == parents.get(edges[2].from + 1);
}

void Classifier::join(std::size_t o, std::int32_t u, std::int32_t v) {
  join_root(o, root(o, u), v);
}

/// Joins a vertex and those whose root is `r`. Their root.
std::int32_t Classifier::join_root(std::size_t o, std::int32_t r,
                                   std::int32_t v) {
  return scratch_.sets[o].unite_roots(r, root(o, v));
}

/// Joins vertices that no part of the other surface separates.
void Classifier::join_vertices(std::size_t o) {
  const Operand& operand = operands_[o];
  scratch_.sets[o].parents().clear();
  scratch_.member[o].clear();
  scratch_.member[o].set(
      0, operands_[1 - o].solid->unbounded ? kInside : kOutside);
  for (std::size_t f = 0; f < operand.solid->faces.size(); ++f) {
    const Face& face = operand.solid->faces[f];
    if (operand.touched[f] != 0 || !overlap(face.box, operand.reach) ||
        operand.common_at(static_cast<std::int32_t>(f)) != Operand::kNotCommon)
      continue;
    const SolidEdge* edges = operand.solid->edges.data() + face.first_edge;
    if (face.edge_count == 3 && is_joined(o, edges)) continue;
    // Loop by loop: the face need not be connected, and where the other
    // operand holds a part of it whole, nothing touches that. The last edge of
    // a loop joins nothing more.
    std::int32_t of_row = -1;
    std::uint32_t row = 0;
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      if (i == row || edges[i].from != edges[i - 1].to) {
        of_row = root(o, edges[i].from);
        row = i;
      }
      if (edges[i].to == edges[row].from) {
        row = i + 1;
      } else {
        of_row = join_root(o, of_row, edges[i].to);
      }
    }
  }
  for (std::size_t e = 0; e < operand.edges.size(); ++e) {
    const OperandEdge& edge = operand.edges[e];
    const auto id = static_cast<std::int32_t>(e);
    if (common_.cuts_of(o, id).empty() && common_.covers_of(o, id).empty() &&
        !operand.is_on_other(edge.low) && !operand.is_on_other(edge.high))
      join(o, edge.low, edge.high);
  }
}

/// Where an edge passes through a face, its ends are on the sides of the face's
/// plane that the crossing separates.
void Classifier::note_members(std::size_t o) {
  for (std::size_t e = 0; e < operands_[o].edges.size(); ++e) {
    const auto id = static_cast<std::int32_t>(e);
    if (common_.cuts_of(o, id).empty()) continue;
    points_on(o, id, points_);
    const std::size_t n = points_.size();
    for (const auto& [end, at] : {std::pair(points_[0], points_[1]),
                                  std::pair(points_[n - 1], points_[n - 2])}) {
      if (operands_[o].is_on_other(end)) continue;
      const auto inside = inside_at_crossing(o, id, at, end);
      if (inside) {
        scratch_.member[o].set(root(o, end), *inside ? kInside : kOutside);
      }
    }
  }
}

void Classifier::points_on(std::size_t o, std::int32_t id,
                           std::vector<std::int32_t>& points) const {
  const OperandEdge& edge = operands_[o].edge(id);
  points.clear();
  for (const EdgeFaceIntersection& cut : common_.cuts_of(o, id)) {
    if (points.empty() || points.back() != cut.vertex)
      points.push_back(cut.vertex);
  }
  points.push_back(edge.low);
  points.push_back(edge.high);
  std::sort(points.begin(), points.end(), [&](std::int32_t u, std::int32_t v) {
    return table_.compare(edge.axis, u, v) < 0;
  });
  HALFSPACE_CHECK(points.front() == edge.low && points.back() == edge.high);
  HALFSPACE_CHECK(std::adjacent_find(points.begin(), points.end()) ==
                  points.end());
}

/// Whether the part of the edge from the cut `at` to `target` is inside, if the
/// edge meets just one face there. It passes through that face's interior: at
/// an edge or a vertex of the other solid it would meet more.
std::optional<bool> Classifier::inside_at_crossing(std::size_t o,
                                                   std::int32_t edge,
                                                   std::int32_t at,
                                                   std::int32_t target) const {
  const auto cuts = common_.cuts_at(o, edge, at);
  if (cuts.size() != 1) return std::nullopt;
  const Face& face = operands_[1 - o].face(cuts[0].face);
  const int side = table_.side(face.plane, target);
  return face.flipped ? side > 0 : side < 0;
}

const PointLocator& Classifier::locator(std::size_t o) {
  if (!locators_[o]) locators_[o].emplace(operands_[o], table_);
  return *locators_[o];
}

/// Whether a vertex that is not on the other operand's surface is inside.
bool Classifier::is_inside(std::size_t o, std::int32_t vertex) {
  const std::int32_t of = root(o, vertex);
  std::uint8_t member = scratch_.member[o].get(of, kUnknown);
  if (member == kUnknown) {
    member = locator(1 - o).is_inside(vertex, vertex) ? kInside : kOutside;
    scratch_.member[o].set(of, member);
  }
  return member == kInside;
}

/// What is known of the vertex's set. Changes nothing.
std::optional<bool> Classifier::known_member(std::size_t o,
                                             std::int32_t vertex) const {
  const SparseParents& parents = scratch_.sets[o].parents();
  std::int32_t of = parents.get(vertex + 1, -1);
  if (of < 0) {
    of = common_.is_beyond_other(o, vertex) ? 0 : vertex + 1;
  } else {
    for (std::int32_t up = parents.get(of); up != of; up = parents.get(of))
      of = up;
  }
  const std::uint8_t member = scratch_.member[o].get(of, kUnknown);
  if (member == kUnknown) return std::nullopt;
  return member == kInside;
}

/// The first of two points on an edge that is an end of it and not on the other
/// surface; -1: neither.
std::int32_t Classifier::free_end(std::size_t o, std::int32_t id,
                                  std::int32_t low, std::int32_t high) const {
  const OperandEdge& edge = operands_[o].edge(id);
  for (const std::int32_t end : {low, high}) {
    if ((end == edge.low || end == edge.high) && !operands_[o].is_on_other(end))
      return end;
  }
  return -1;
}

std::optional<bool> Classifier::inside_from_crossing(std::size_t o,
                                                     std::int32_t id,
                                                     std::int32_t low,
                                                     std::int32_t high) const {
  if (const auto inside = inside_at_crossing(o, id, low, high)) return inside;
  return inside_at_crossing(o, id, high, low);
}

bool Classifier::is_part_inside(std::size_t o, std::int32_t id,
                                std::int32_t low, std::int32_t high) {
  HALFSPACE_CHECK(low != high);
  const std::int32_t end = free_end(o, id, low, high);
  if (end >= 0) return is_inside(o, end);
  const auto inside = inside_from_crossing(o, id, low, high);
  return inside ? *inside : locator(1 - o).is_inside(low, high);
}

bool Classifier::is_part_inside(std::size_t o, std::int32_t id,
                                const std::vector<std::int32_t>& points,
                                std::size_t part,
                                const std::optional<KnownPart>& before) {
  HALFSPACE_CHECK(part + 1 < points.size());
  HALFSPACE_CHECK(!before || before->part < part);
  const std::int32_t low = points[part];
  const std::int32_t high = points[part + 1];
  const std::int32_t end = free_end(o, id, low, high);
  if (end >= 0) return is_inside(o, end);
  auto inside = inside_from_crossing(o, id, low, high);
  if (!inside && before)
    inside = inside_from_part(o, id, points, *before, part);
  return inside ? *inside : locator(1 - o).is_inside(low, high);
}

std::optional<bool> Classifier::known_part(std::size_t o, std::int32_t id,
                                           std::int32_t low,
                                           std::int32_t high) const {
  const std::int32_t end = free_end(o, id, low, high);
  return end >= 0 ? known_member(o, end)
                  : inside_from_crossing(o, id, low, high);
}

std::optional<bool> Classifier::known_part(
    std::size_t o, std::int32_t id, const std::vector<std::int32_t>& points,
    std::size_t part, const std::optional<KnownPart>& before) const {
  const auto inside = known_part(o, id, points[part], points[part + 1]);
  if (inside || !before) return inside;
  return inside_from_part(o, id, points, *before, part);
}

/// Whether part `i` of the points is inside, from the membership of a part
/// before it. Parts between them may lie on the surface: they count as points
/// right beside them, as in PointLocator::winding().
///
/// The winding number changes only by faces incident to the point that two
/// parts share. Rays that cross another face's edge gain and lose both of its
/// neighbours at once, so they cancel. An exception: a face there whose plane
/// is along the ray and crossed by the edge also changes it far away, where the
/// face ends.
std::optional<bool> Classifier::inside_from_part(
    std::size_t o, std::int32_t id, const std::vector<std::int32_t>& points,
    const KnownPart& before, std::size_t i) const {
  const Operand& other = operands_[1 - o];
  // Along the edge there is no such face, unless the edge is oblique.
  const int axis = operands_[o].edge(id).axis;
  const PointLocator& faces = near_faces_[1 - o];
  int winding = before.inside ? 1 : 0;
  for (std::size_t k = before.part + 1; k <= i; ++k) {
    for (const EdgeFaceIntersection& cut : common_.cuts_at(o, id, points[k])) {
      const Face& face = other.face(cut.face);
      if (face.edge_count == 0 || (table_.normal_sign(face.plane, axis) == 0 &&
                                   table_.side(face.plane, points[k + 1]) != 0))
        return std::nullopt;
      winding +=
          faces.ray_contribution(axis, cut.face, points[k], points[k + 1]) -
          faces.ray_contribution(axis, cut.face, points[k], points[k - 1]);
    }
  }
  // Never true: solids wind round no point twice.
  if (winding < 0 || winding > 1) return std::nullopt;
  return winding == 1;
}

}  // namespace halfspace::fast
