#include "boolean_engine.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "boolean_contact.hpp"

namespace halfspace::fast {

Engine::Engine(const Truth& truth, const Solid& a, const Solid& b, Space& space)
    : truth_(truth), space_(space) {
  operands_[0].solid = &a;
  operands_[1].solid = &b;
}

Solid Engine::run() {
  find_contacts();
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
  for (Operand& operand : operands_) add_boxes(operand);
  const auto pairs = near_pairs(operands_[0], operands_[1]);
  for (Operand& operand : operands_) add_edges(operand, space_);
  Contact contact(operands_[0], operands_[1], space_, traces_);
  for (const auto& [f, g] : pairs) contact.meet(f, g);
}

/// Brings the cuts and covers of each edge together.
void Engine::sort_records(std::size_t o) {
  Operand& operand = operands_[o];
  const auto sort = [&](auto& records, std::vector<std::uint32_t>& first) {
    std::sort(records.begin(), records.end(), [](const auto& x, const auto& y) {
      return std::tie(x.edge, x.face) < std::tie(y.edge, y.face);
    });
    first.assign(operand.edges.size() + 1, 0);
    for (const auto& record : records)
      ++first[static_cast<std::size_t>(record.edge) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
  };
  sort(operand.cuts, first_cut_[o]);
  sort(operand.covers, first_cover_[o]);
}

/// What an edge meets is reported by one of its faces: it touches them all.
void Engine::mark_touched(std::size_t o) {
  Operand& operand = operands_[o];
  for (const std::int32_t f : operand.active) {
    const Face& face = operand.face(f);
    const SolidEdge* edges = operand.edges_of(f);
    std::uint8_t& touched = operand.touched[static_cast<std::size_t>(f)];
    for (std::uint32_t i = 0; i < face.edge_count && touched == 0; ++i) {
      const std::int32_t id = operand.edge_of[face.first_edge + i];
      touched = operand.is_on_other(edges[i].from) || !cuts_of(o, id).empty() ||
                !covers_of(o, id).empty();
    }
  }
}

std::span<const Cut> Engine::cuts_of(std::size_t o, std::int32_t edge) const {
  const auto e = static_cast<std::size_t>(edge);
  return std::span(operands_[o].cuts)
      .subspan(first_cut_[o][e], first_cut_[o][e + 1] - first_cut_[o][e]);
}

std::span<const Cover> Engine::covers_of(std::size_t o,
                                         std::int32_t edge) const {
  const auto e = static_cast<std::size_t>(edge);
  return std::span(operands_[o].covers)
      .subspan(first_cover_[o][e], first_cover_[o][e + 1] - first_cover_[o][e]);
}

std::int32_t Engine::root(std::size_t o, std::int32_t v) {
  auto& parent = parent_[o];
  while (parent[static_cast<std::size_t>(v)] != v) {
    std::int32_t& up = parent[static_cast<std::size_t>(v)];
    up = parent[static_cast<std::size_t>(up)];
    v = up;
  }
  return v;
}

/// Joins vertices that are on the same side of the other operand's surface,
/// because the surface does not come between.
void Engine::join_vertices(std::size_t o) {
  const Operand& operand = operands_[o];
  parent_[o].resize(space_.vertex_count());
  std::iota(parent_[o].begin(), parent_[o].end(), 0);
  member_[o].assign(space_.vertex_count(), Member::kUnknown);
  const auto join = [&](std::int32_t u, std::int32_t v) {
    const std::int32_t r = root(o, u);
    const std::int32_t s = root(o, v);
    parent_[o][static_cast<std::size_t>(std::max(r, s))] = std::min(r, s);
  };
  for (std::size_t f = 0; f < operand.solid->faces.size(); ++f) {
    const Face& face = operand.solid->faces[f];
    const SolidEdge* edges = operand.solid->edges.data() + face.first_edge;
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      if (operand.touched[f] == 0) {
        join(edges[0].from, edges[i].from);
        continue;
      }
      const std::int32_t id = operand.edge_of[face.first_edge + i];
      if (cuts_of(o, id).empty() && covers_of(o, id).empty() &&
          !operand.is_on_other(edges[i].from) &&
          !operand.is_on_other(edges[i].to))
        join(edges[i].from, edges[i].to);
    }
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
        member_[o][static_cast<std::size_t>(root(o, end))] =
            *told ? Member::kInside : Member::kOutside;
      }
    }
  }
}

void Engine::find_points(std::size_t o, std::int32_t id) {
  const LineEdge& edge = operands_[o].edge(id);
  points_.clear();
  for (const Cut& cut : cuts_of(o, id)) points_.push_back(cut.vertex);
  std::sort(points_.begin(), points_.end());
  points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  points_.push_back(edge.low);
  points_.push_back(edge.high);
  std::sort(points_.begin(), points_.end(),
            [&](std::int32_t u, std::int32_t v) {
              return space_.compare(edge.axis, u, v) < 0;
            });
}

/// Whether the part of the edge from the cut `at` to `towards` is inside, if
/// the edge passes through the interior of just one face there.
std::optional<bool> Engine::crossing_tells(std::size_t o, std::int32_t edge,
                                           std::int32_t at,
                                           std::int32_t towards) const {
  const Cut* found = nullptr;
  for (const Cut& cut : cuts_of(o, edge)) {
    if (cut.vertex != at) continue;
    if (found != nullptr || !cut.through) return std::nullopt;
    found = &cut;
  }
  if (found == nullptr) return std::nullopt;
  const Face& face = operands_[1 - o].face(found->face);
  const int side = space_.side(face.plane, towards);
  return face.turned ? side > 0 : side < 0;
}

const Locator& Engine::locator(std::size_t o) {
  if (!locators_[o]) locators_[o].emplace(operands_[o], space_);
  return *locators_[o];
}

/// Whether a vertex that is not on the other operand's surface is inside.
bool Engine::is_inside(std::size_t o, std::int32_t vertex) {
  Member& member = member_[o][static_cast<std::size_t>(root(o, vertex))];
  if (member == Member::kUnknown) {
    member = locator(1 - o).is_inside(vertex, vertex) ? Member::kInside
                                                      : Member::kOutside;
  }
  return member == Member::kInside;
}

/// Whether a part of an edge that is not on the other operand's surface, but
/// for its ends, is inside.
bool Engine::is_part_inside(std::size_t o, std::int32_t id, std::int32_t low,
                            std::int32_t high) {
  const LineEdge& edge = operands_[o].edge(id);
  for (const std::int32_t end : {low, high}) {
    if ((end == edge.low || end == edge.high) && !operands_[o].is_on_other(end))
      return is_inside(o, end);
  }
  if (const auto told = crossing_tells(o, id, low, high)) return *told;
  if (const auto told = crossing_tells(o, id, high, low)) return *told;
  return locator(1 - o).is_inside(low, high);
}

}  // namespace halfspace::fast
