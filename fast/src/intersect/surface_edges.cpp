#include "intersect/surface_edges.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "base/disjoint_sets.hpp"
#include "base/id_map.hpp"

namespace halfspace::fast {
namespace {

/// A use of an edge, in a list of those with one lesser end.
struct EdgeUseAt {
  std::uint32_t edge;
  std::int32_t face;
  std::uint32_t other_end : 31;
  std::uint32_t is_upwards : 1;
};

/// The uses of an edge, of those with one lesser end.
struct UsesOfEdge {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::int32_t count = 0;
  std::int32_t excess = 0;
};

}  // namespace

SurfaceEdges::SurfaceEdges(const Solid& solid)
    : neighbours_(solid.edges.size(), -1) {
  if (solid.edges.empty()) return;
  IdRange extent;
  for (const SolidEdge& edge : solid.edges) {
    extent.add(edge.from);
    extent.add(edge.to);
  }
  // Step 1: the uses of edges by their lesser ends.
  IdMap places(extent);
  List<std::uint32_t> first(places.size() + 1);
  for (const SolidEdge& edge : solid.edges)
    ++first[places(std::min(edge.from, edge.to)) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  List<EdgeUseAt> uses(solid.edges.size());
  List<std::uint32_t> end(first.begin(), first.end() - 1);
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Face& face = solid.faces[f];
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const std::uint32_t at = face.first_edge + i;
      const auto [low, high] =
          std::minmax(solid.edges[at].from, solid.edges[at].to);
      const auto other = static_cast<std::uint32_t>(places(high));
      uses[end[places(low)]++] = {at, static_cast<std::int32_t>(f),
                                  other & 0x7fffffffu,
                                  solid.edges[at].from == low ? 1u : 0u};
    }
  }
  // Step 2: those with the same other end.
  List<UsesOfEdge> by_end(places.size());
  for (std::size_t place = 0; place < end.size(); ++place) {
    const std::uint32_t begin = first[place], stop = end[place];
    for (std::uint32_t u = begin; u < stop; ++u) {
      UsesOfEdge& of = by_end[uses[u].other_end];
      of.first = of.second;
      of.second = u;
      ++of.count;
      of.excess += uses[u].is_upwards != 0 ? 1 : -1;
    }
    for (std::uint32_t u = begin; u < stop; ++u) {
      UsesOfEdge& of = by_end[uses[u].other_end];
      is_closed_ = is_closed_ && of.excess == 0;
      if (of.count == 2 && of.excess == 0) {
        const EdgeUseAt& other = uses[of.first == u ? of.second : of.first];
        neighbours_[uses[u].edge] = other.face;
      }
    }
    for (std::uint32_t u = begin; u < stop; ++u) by_end[uses[u].other_end] = {};
  }
}

std::vector<std::int32_t> parts_of_surface(const Solid& solid,
                                           const SurfaceEdges& edges) {
  DisjointSets faces(solid.faces.size());
  edges.for_neighbours(
      solid, [&](std::int32_t f, std::int32_t g) { faces.unite(f, g); });
  std::vector<std::int32_t> parts(solid.faces.size());
  for (std::size_t f = 0; f < parts.size(); ++f)
    parts[f] = faces.root(static_cast<std::int32_t>(f));
  return parts;
}

}  // namespace halfspace::fast
