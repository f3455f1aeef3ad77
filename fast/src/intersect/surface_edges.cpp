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
  std::int32_t other_end;
  bool is_upwards;
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
  std::vector<std::uint32_t> first(places.size() + 1);
  for (const SolidEdge& edge : solid.edges)
    ++first[places(std::min(edge.from, edge.to)) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<EdgeUseAt> uses(solid.edges.size());
  std::vector<std::uint32_t> end(first.begin(), first.end() - 1);
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Face& face = solid.faces[f];
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const std::uint32_t at = face.first_edge + i;
      const auto [low, high] =
          std::minmax(solid.edges[at].from, solid.edges[at].to);
      uses[end[places.find(low)]++] = {at, static_cast<std::int32_t>(f), high,
                                       solid.edges[at].from == low};
    }
  }
  // Step 2: those with the same other end.
  for (std::size_t place = 0; place < end.size(); ++place) {
    const auto begin = uses.begin() + first[place];
    const auto stop = uses.begin() + end[place];
    std::sort(begin, stop, [](const EdgeUseAt& x, const EdgeUseAt& y) {
      return x.other_end < y.other_end;
    });
    for (auto use = begin; use != stop;) {
      auto next = use;
      int excess = 0;
      for (; next != stop && next->other_end == use->other_end; ++next)
        excess += next->is_upwards ? 1 : -1;
      is_closed_ = is_closed_ && excess == 0;
      if (next - use == 2 && excess == 0) {
        neighbours_[use->edge] = use[1].face;
        neighbours_[use[1].edge] = use->face;
      }
      use = next;
    }
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
