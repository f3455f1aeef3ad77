#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/parallel.hpp"
#include "boolean/engine.hpp"
#include "intersect/face_intersection.hpp"

namespace halfspace::fast {

Engine::Engine(BooleanOp operation, const Solid& a, const Solid& b,
               TableLease& lease, int threads)
    : operation_(operation),
      threads_(threads),
      table_(lease.table()),
      scratch_(lease.scratch<BooleanScratch>()) {
  operands_[0].solid = &a;
  operands_[1].solid = &b;
  is_conforming_ = {is_known_conforming(a), is_known_conforming(b)};
}

Engine::Engine(BooleanOp operation, const Solid& a, const Solid& b,
               TableLease& lease, const Whole& whole)
    : Engine(operation, a, b, lease) {
  operands_[0].whole = whole.solid;
  operands_[0].index = whole.index;
  operands_[0].blocks = whole.part_blocks;
  operands_[0].whole_blocks = whole.blocks;
  operands_[0].extent = whole.extent;
}

Solid Engine::run() {
  for (std::size_t o = 0; o < 2; ++o) {
    sort_records(o);
    mark_touched(o);
    join_vertices(o);
    note_members(o);
  }
  emit_edges(0);
  emit_edges(1);
  emit_traces();
  return result();
}

void Engine::find_contacts() {
  prepare(operands_[0], operands_[1], scratch_);
  auto pairs = near_pairs(operands_[0], operands_[1], threads_);
  if (threads_ > 1) drop_apart(pairs);
  for (Operand& operand : operands_) add_edges(operand, table_);
  Contact contact(operands_[0], operands_[1], table_, traces_);
  for (const auto& [f, g] : pairs) contact.meet(f, g);
  for (std::size_t o = 0; o < 2; ++o) {
    has_nodes_[o] =
        is_conforming_[o] || add_nodes(o, operands_, traces_, table_);
  }
}

/// Drops the pairs of faces that have nothing in common, which are most. Only
/// the others add points to the table, which is done in their order.
void Engine::drop_apart(
    std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) {
  oneapi::tbb::enumerable_thread_specific<Contact> contacts(
      [this] { return Contact(operands_[0], operands_[1], table_, traces_); });
  std::vector<std::uint8_t> stays(pairs.size());
  for_blocks(threads_, pairs.size(), 1024,
             [&](std::size_t, std::size_t first, std::size_t last) {
               Contact& contact = contacts.local();
               for (std::size_t i = first; i < last; ++i)
                 stays[i] = contact.may_meet(pairs[i].first, pairs[i].second);
             });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (stays[i] != 0) pairs[kept++] = pairs[i];
  }
  pairs.resize(kept);
}

/// Brings the cuts and covers of each edge together.
void Engine::sort_records(std::size_t o) {
  Operand& operand = operands_[o];
  const auto index = [&](const auto& records,
                         std::vector<std::uint32_t>& first) {
    first.assign(operand.edges.size() + 1, 0);
    for (const auto& record : records)
      ++first[static_cast<std::size_t>(record.edge) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
  };
  std::sort(operand.cuts.begin(), operand.cuts.end(),
            [](const Cut& x, const Cut& y) {
              return std::tie(x.edge, x.vertex, x.face) <
                     std::tie(y.edge, y.vertex, y.face);
            });
  std::sort(operand.covers.begin(), operand.covers.end(),
            [](const Cover& x, const Cover& y) {
              return std::tie(x.edge, x.face) < std::tie(y.edge, y.face);
            });
  index(operand.cuts, first_cut_[o]);
  index(operand.covers, first_cover_[o]);
}

/// What an edge meets is reported by one of its faces: it touches them all. A
/// face that lies within another in its plane may be told so by this alone.
void Engine::mark_touched(std::size_t o) {
  const Operand& operand = operands_[o];
  for (std::size_t e = 0; e < operand.edges.size(); ++e) {
    const LineEdge& edge = operand.edges[e];
    const auto id = static_cast<std::int32_t>(e);
    if (operand.is_on_other(edge.low) || operand.is_on_other(edge.high) ||
        !cuts_of(o, id).empty() || !covers_of(o, id).empty())
      touch_faces_at(o, edge);
  }
}

void Engine::touch_faces_at(std::size_t o, const LineEdge& edge) {
  Operand& operand = operands_[o];
  for (std::uint32_t u = 0; u < edge.use_count; ++u) {
    const EdgeUse& use = operand.uses[edge.first_use + u];
    operand.touched[static_cast<std::size_t>(use.face)] = 1;
  }
}

std::span<const Cut> Engine::cuts_of(std::size_t o, std::int32_t edge) const {
  const auto e = static_cast<std::size_t>(edge);
  return std::span(operands_[o].cuts)
      .subspan(first_cut_[o][e], first_cut_[o][e + 1] - first_cut_[o][e]);
}

std::span<const Cut> Engine::cuts_at(std::size_t o, std::int32_t edge,
                                     std::int32_t vertex) const {
  const auto cuts = cuts_of(o, edge);
  const auto first = std::partition_point(
      cuts.begin(), cuts.end(),
      [vertex](const Cut& cut) { return cut.vertex < vertex; });
  const auto last = std::partition_point(
      first, cuts.end(),
      [vertex](const Cut& cut) { return cut.vertex == vertex; });
  return {first, last};
}

std::span<const Cover> Engine::covers_of(std::size_t o,
                                         std::int32_t edge) const {
  const auto e = static_cast<std::size_t>(edge);
  return std::span(operands_[o].covers)
      .subspan(first_cover_[o][e], first_cover_[o][e + 1] - first_cover_[o][e]);
}

std::int32_t Engine::find_root(std::size_t o, std::int32_t vertex) {
  SparseDisjointSets& sets = scratch_.sets[o];
  if (sets.parents().get(vertex + 1, -1) < 0)
    sets.attach(vertex + 1, is_beyond_other(o, vertex) ? 0 : vertex + 1);
  return sets.root(vertex + 1);
}

/// Whether a triangle's vertices are known to be joined: most are, by the
/// triangles beside it.
bool Engine::is_joined(std::size_t o, const SolidEdge* edges) const {
  // A vertex of no set yet is its own parent, so different from the others'.
  const SparseParents& parents = scratch_.sets[o].parents();
  const std::int32_t up = parents.get(edges[0].from + 1);
  return up == parents.get(edges[1].from + 1) &&
         up == parents.get(edges[2].from + 1);
}

void Engine::join(std::size_t o, std::int32_t u, std::int32_t v) {
  join_root(o, root(o, u), v);
}

/// Joins a vertex and those whose root is `r`. Their root.
std::int32_t Engine::join_root(std::size_t o, std::int32_t r, std::int32_t v) {
  return scratch_.sets[o].unite_roots(r, root(o, v));
}

/// Joins vertices that are on the same side of the other operand's surface,
/// because the surface does not come between.
void Engine::join_vertices(std::size_t o) {
  const Operand& operand = operands_[o];
  scratch_.sets[o].parents().clear();
  scratch_.member[o].clear();
  scratch_.member[o].set(
      0, operands_[1 - o].solid->unbounded ? kInside : kOutside);
  for (std::size_t f = 0; f < operand.solid->faces.size(); ++f) {
    const Face& face = operand.solid->faces[f];
    if (operand.touched[f] != 0 || !overlap(face.box, operand.reach)) continue;
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
    const LineEdge& edge = operand.edges[e];
    const auto id = static_cast<std::int32_t>(e);
    if (cuts_of(o, id).empty() && covers_of(o, id).empty() &&
        !operand.is_on_other(edge.low) && !operand.is_on_other(edge.high))
      join(o, edge.low, edge.high);
  }
}

/// Where an edge passes through a face, the face tells on which side of it
/// the edge's ends are.
void Engine::note_members(std::size_t o) {
  for (std::size_t e = 0; e < operands_[o].edges.size(); ++e) {
    const auto id = static_cast<std::int32_t>(e);
    if (cuts_of(o, id).empty()) continue;
    find_points(o, id);
    const std::size_t n = points_.size();
    for (const auto& [end, at] : {std::pair(points_[0], points_[1]),
                                  std::pair(points_[n - 1], points_[n - 2])}) {
      if (operands_[o].is_on_other(end)) continue;
      const auto told = crossing_tells(o, id, at, end);
      if (told) {
        scratch_.member[o].set(root(o, end), *told ? kInside : kOutside);
      }
    }
  }
}

void Engine::find_points(std::size_t o, std::int32_t id) {
  const LineEdge& edge = operands_[o].edge(id);
  points_.clear();
  for (const Cut& cut : cuts_of(o, id)) {
    if (points_.empty() || points_.back() != cut.vertex)
      points_.push_back(cut.vertex);
  }
  points_.push_back(edge.low);
  points_.push_back(edge.high);
  std::sort(points_.begin(), points_.end(),
            [&](std::int32_t u, std::int32_t v) {
              return table_.compare(edge.axis, u, v) < 0;
            });
}

/// Whether the part of the edge from the cut `at` to `towards` is inside, if
/// the edge meets just one face there. It passes through that one's interior:
/// at an edge or a vertex of the other solid it would meet more.
std::optional<bool> Engine::crossing_tells(std::size_t o, std::int32_t edge,
                                           std::int32_t at,
                                           std::int32_t towards) const {
  const auto cuts = cuts_at(o, edge, at);
  if (cuts.size() != 1) return std::nullopt;
  const Face& face = operands_[1 - o].face(cuts[0].face);
  const int side = table_.side(face.plane, towards);
  return face.flipped ? side > 0 : side < 0;
}

const Locator& Engine::locator(std::size_t o) {
  if (!locators_[o]) locators_[o].emplace(operands_[o], table_);
  return *locators_[o];
}

/// Whether a vertex that is not on the other operand's surface is inside.
bool Engine::is_inside(std::size_t o, std::int32_t vertex) {
  const std::int32_t of = root(o, vertex);
  std::uint8_t member = scratch_.member[o].get(of, kUnknown);
  if (member == kUnknown) {
    member = locator(1 - o).is_inside(vertex, vertex) ? kInside : kOutside;
    scratch_.member[o].set(of, member);
  }
  return member == kInside;
}

/// Whether a part of an edge that is not on the other operand's surface, but
/// for its ends, is inside, if one of the ends tells.
std::optional<bool> Engine::told_inside(std::size_t o, std::int32_t id,
                                        std::int32_t low, std::int32_t high) {
  const LineEdge& edge = operands_[o].edge(id);
  for (const std::int32_t end : {low, high}) {
    if ((end == edge.low || end == edge.high) && !operands_[o].is_on_other(end))
      return is_inside(o, end);
  }
  if (const auto told = crossing_tells(o, id, low, high)) return told;
  return crossing_tells(o, id, high, low);
}

bool Engine::is_part_inside(std::size_t o, std::int32_t id, std::int32_t low,
                            std::int32_t high) {
  if (const auto told = told_inside(o, id, low, high)) return *told;
  return locator(1 - o).is_inside(low, high);
}

/// Likewise of the edge's part `i`, of points_, if what is inside is known of
/// the part before it. Between them may be parts on the surface: they
/// count as what is right beside them, as Locator::winding has it.
///
/// Where two parts meet, only the faces there make a difference: of others that
/// a ray from right beside the point meets, those that it passes at an edge of
/// theirs come and go together. But if the edge passes through the plane of a
/// face there that is along the ray, so it does far away, where that face ends.
std::optional<bool> Engine::carried_inside(std::size_t o, std::int32_t id,
                                           const KnownPart& before,
                                           std::size_t i) {
  const Operand& other = operands_[1 - o];
  // Along the edge there is no such face, unless the edge is oblique.
  const int axis = operands_[o].edge(id).axis;
  std::optional<Locator>& faces = near_locators_[1 - o];
  if (!faces) faces.emplace(*other.solid, table_, nullptr, other.blocks.get());
  int winding = before.inside ? 1 : 0;
  for (std::size_t k = before.part + 1; k <= i; ++k) {
    for (const Cut& cut : cuts_at(o, id, points_[k])) {
      const Face& face = other.face(cut.face);
      if (face.edge_count == 0 ||
          (table_.normal_sign(face.plane, axis) == 0 &&
           table_.side(face.plane, points_[k + 1]) != 0))
        return std::nullopt;
      winding += faces->share(axis, cut.face, points_[k], points_[k + 1]) -
                 faces->share(axis, cut.face, points_[k], points_[k - 1]);
    }
  }
  // Never true: solids wind round no point twice.
  if (winding < 0 || winding > 1) return std::nullopt;
  return winding == 1;
}

}  // namespace halfspace::fast
