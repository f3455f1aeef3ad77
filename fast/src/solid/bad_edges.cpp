#include "halfspace/fast/bad_edges.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace halfspace::fast {

std::vector<BadEdge> bad_edges(const Solid& solid) {
  // Uses from the lesser end to the greater one count up, the others down.
  std::vector<BadEdge> uses;
  uses.reserve(solid.edges.size());
  for (const SolidEdge& edge : solid.edges) {
    const auto [low, high] = std::minmax(edge.from, edge.to);
    uses.push_back({low, high, edge.from == low ? 1 : -1});
  }
  std::sort(uses.begin(), uses.end(), [](const BadEdge& x, const BadEdge& y) {
    return std::tie(x.from, x.to) < std::tie(y.from, y.to);
  });
  std::vector<BadEdge> bad;
  for (std::size_t i = 0; i < uses.size();) {
    BadEdge sum = uses[i];
    for (++i;
         i < uses.size() && uses[i].from == sum.from && uses[i].to == sum.to;
         ++i)
      sum.excess += uses[i].excess;
    if (sum.excess < 0) {
      std::swap(sum.from, sum.to);
      sum.excess = -sum.excess;
    }
    if (sum.excess != 0) bad.push_back(sum);
  }
  return bad;
}

std::vector<std::int32_t> open_faces(const Solid& solid) {
  std::vector<std::int32_t> open, from, to;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Face& face = solid.faces[f];
    from.clear();
    to.clear();
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      from.push_back(solid.edges[face.first_edge + i].from);
      to.push_back(solid.edges[face.first_edge + i].to);
    }
    std::sort(from.begin(), from.end());
    std::sort(to.begin(), to.end());
    if (from != to) open.push_back(static_cast<std::int32_t>(f));
  }
  return open;
}

}  // namespace halfspace::fast
