#include <algorithm>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "solid/face_projection.hpp"
#include "solid/face_triangulation.hpp"

namespace halfspace::fast {

namespace {

/// Orders edges so that each begins where the one before it ends, as far as
/// that goes.
void put_in_row(std::vector<SolidEdge>& edges) {
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    const auto next = std::find_if(
        edges.begin() + static_cast<std::ptrdiff_t>(k) + 1, edges.end(),
        [&](const SolidEdge& edge) { return edge.from == edges[k].to; });
    if (next == edges.end()) return;
    std::swap(edges[k + 1], *next);
  }
}

/// A triangle's edge.
struct Entry {
  std::int32_t from, to;
  std::size_t triangle;
  std::pair<std::int32_t, std::int32_t> ends() const { return {from, to}; }
};

/// The triangles' edges in the order of their ends.
std::vector<Entry> sorted_edges(
    const std::vector<std::array<std::int32_t, 3>>& triangles) {
  std::vector<Entry> entries;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i)
      entries.push_back({triangles[t][i], triangles[t][(i + 1) % 3], t});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& x, const Entry& y) { return x.ends() < y.ends(); });
  return entries;
}

}  // namespace

std::vector<std::int32_t> convex_loop(const Solid& solid, const Face& face,
                                      std::span<const SolidEdge> edges) {
  const FaceProjection view(solid, face);
  const std::size_t count = edges.size();
  std::vector<std::int32_t> loop;
  // A loop that never turns to the right and goes leftwards once is convex.
  int returns = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const SolidEdge& edge = edges[i];
    const SolidEdge& next = edges[(i + 1) % count];
    if (edge.to != next.from || next.to == edge.from ||
        view.turn(edge.from, edge.to, next.to) < 0)
      return {};
    returns +=
        view.before(edge.from, edge.to) && view.before(next.to, next.from) ? 1
                                                                           : 0;
    loop.push_back(edge.from);
  }
  if (returns != 1) return {};
  return loop;
}

void join_convex(const Solid& solid, const Face& face,
                 const std::vector<std::array<std::int32_t, 3>>& triangles,
                 std::vector<std::vector<std::int32_t>>& polygons) {
  // Step 1: the triangles' edges, and those of the face.
  const std::vector<Entry> entries = sorted_edges(triangles);
  std::vector<std::pair<std::int32_t, std::int32_t>> outer;
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    const SolidEdge& edge = solid.edges[face.first_edge + i];
    outer.emplace_back(edge.from, edge.to);
  }
  std::sort(outer.begin(), outer.end());
  // Step 2: triangles on either side of an edge within the face are one part.
  DisjointSets parts(triangles.size());
  const auto root = [&parts](std::size_t t) {
    return parts.root(static_cast<std::int32_t>(t));
  };
  for (const Entry& e : entries) {
    if (std::binary_search(outer.begin(), outer.end(), e.ends())) continue;
    const auto back = std::lower_bound(
        entries.begin(), entries.end(), std::pair(e.to, e.from),
        [&](const Entry& x, const auto& key) { return x.ends() < key; });
    // There is none only where the face's edges cross: then it stays alone.
    if (back != entries.end() && back->ends() == std::pair(e.to, e.from))
      parts.attach(root(e.triangle), root(back->triangle));
  }
  // Step 3: each part's edges on the outside, in a row.
  std::vector<std::pair<std::int32_t, Entry>> bounds;
  for (const Entry& e : entries) {
    if (std::binary_search(outer.begin(), outer.end(), e.ends()))
      bounds.emplace_back(root(e.triangle), e);
  }
  std::stable_sort(
      bounds.begin(), bounds.end(),
      [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<bool> joined(triangles.size());
  for (auto i = bounds.begin(); i != bounds.end();) {
    const std::int32_t part = i->first;
    std::vector<SolidEdge> row;
    auto j = i;
    for (; j != bounds.end() && j->first == part; ++j)
      row.push_back({j->second.from, j->second.to});
    put_in_row(row);
    auto loop = convex_loop(solid, face, row);
    joined[static_cast<std::size_t>(part)] = !loop.empty();
    if (!loop.empty()) polygons.push_back(std::move(loop));
    i = j;
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!joined[static_cast<std::size_t>(root(t))])
      polygons.emplace_back(triangles[t].begin(), triangles[t].end());
  }
}

}  // namespace halfspace::fast
