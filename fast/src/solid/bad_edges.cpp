#include "halfspace/fast/bad_edges.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace halfspace::fast {
namespace {

std::int32_t low_of(const SolidEdge& edge) {
  return std::min(edge.from, edge.to);
}

/// The uses of edges, those of one lesser end in a row, in the order of these
/// ends or nearly: by runs of ids, of which there are fewer than edges. Uses
/// from the lesser end to the greater one count up, the others down.
struct Uses {
  std::vector<BadEdge> uses;
  std::vector<std::uint32_t> first;  ///< by run; and the end
};

Uses uses_of(std::span<const SolidEdge> edges) {
  std::int32_t least = low_of(edges.front()), most = least;
  for (const SolidEdge& edge : edges) {
    least = std::min(least, low_of(edge));
    most = std::max(most, low_of(edge));
  }
  const auto range =
      static_cast<std::size_t>(std::int64_t{most} - std::int64_t{least}) + 1;
  // Ids of a table that other solids use, too, may be far apart.
  const int shift = static_cast<int>(std::bit_width(range / edges.size())) - 1;
  const auto run_of = [&](std::int32_t low) {
    const auto at =
        static_cast<std::size_t>(std::int64_t{low} - std::int64_t{least});
    return shift > 0 ? at >> shift : at;
  };
  Uses made{std::vector<BadEdge>(edges.size()),
            std::vector<std::uint32_t>(run_of(most) + 2)};
  for (const SolidEdge& edge : edges) ++made.first[run_of(low_of(edge)) + 1];
  std::partial_sum(made.first.begin(), made.first.end(), made.first.begin());
  std::vector<std::uint32_t> at(made.first.begin(), made.first.end() - 1);
  for (const SolidEdge& edge : edges) {
    const auto [low, high] = std::minmax(edge.from, edge.to);
    made.uses[at[run_of(low)]++] = {low, high, edge.from == low ? 1 : -1};
  }
  return made;
}

/// Adds what is left of the uses of some edges, all of them, to `bad`.
void add_bad(std::span<BadEdge> uses, std::vector<BadEdge>& bad) {
  std::sort(uses.begin(), uses.end(), [](const BadEdge& x, const BadEdge& y) {
    return std::tie(x.from, x.to) < std::tie(y.from, y.to);
  });
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
}

/// Whether each edge begins where the one before ends.
bool is_loop(std::span<const SolidEdge> edges) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].to != edges[i + 1 < edges.size() ? i + 1 : 0].from)
      return false;
  }
  return true;
}

}  // namespace

std::vector<BadEdge> bad_edges(const Solid& solid) {
  std::vector<BadEdge> bad;
  if (solid.edges.empty()) return bad;
  Uses all = uses_of(solid.edges);
  for (std::size_t i = 0; i + 1 < all.first.size(); ++i) {
    add_bad(std::span(all.uses).subspan(all.first[i],
                                        all.first[i + 1] - all.first[i]),
            bad);
  }
  return bad;
}

std::vector<std::int32_t> open_faces(const Solid& solid) {
  std::vector<std::int32_t> open, from, to;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Face& face = solid.faces[f];
    if (is_loop(
            std::span(solid.edges).subspan(face.first_edge, face.edge_count)))
      continue;
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
