#include "halfspace/boolean.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace halfspace {
namespace {

std::string text_of(const GridPoint& p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " +
         std::to_string(p.z) + ")";
}

/// By vertex, the place of its point among all of them in order: equal points
/// have one place.
std::vector<std::uint32_t> places_of(const std::vector<GridPoint>& points,
                                     std::vector<GridPoint>& in_order) {
  // Beside its point, for a sort that looks up points takes twice as long.
  struct Entry {
    GridPoint point;
    std::uint32_t id = 0;
  };
  std::vector<Entry> entries;
  entries.reserve(points.size());
  for (const GridPoint& point : points)
    entries.push_back({point, static_cast<std::uint32_t>(entries.size())});
  std::sort(entries.begin(), entries.end(),
            [](const Entry& u, const Entry& v) { return u.point < v.point; });
  std::vector<std::uint32_t> places(points.size());
  for (const auto& [point, id] : entries) {
    if (in_order.empty() || in_order.back() != point) in_order.push_back(point);
    places[id] = static_cast<std::uint32_t>(in_order.size() - 1);
  }
  return places;
}

/// Whether every edge is used equally often in each direction if vertices are
/// distinguished by index. Then the same holds by their points.
bool is_closed_by_index(const Scene& scene) {
  // The other ends of edges by the lesser one, and whether they go down.
  const std::size_t count = scene.data().vertices.size();
  std::vector<std::uint32_t> first(count + 1);
  const auto for_edges = [&](const auto& visit) {
    const auto edge = [&](VertexId from, VertexId to) {
      visit(static_cast<std::size_t>(std::min(from, to)),
            static_cast<std::uint32_t>(std::max(from, to)) << 1 |
                (from > to ? 1u : 0u));
    };
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const auto corners = scene.corners(static_cast<PolygonId>(p));
      edge(corners.back(), corners[0]);
      if (corners.size() == 3) {
        // Most are triangles: no loop.
        edge(corners[0], corners[1]);
        edge(corners[1], corners[2]);
        continue;
      }
      for (std::size_t i = 1; i < corners.size(); ++i)
        edge(corners[i - 1], corners[i]);
    }
  };
  for_edges([&](std::size_t low, std::uint32_t) { ++first[low + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> uses(scene.data().corners.size());
  std::vector<std::uint32_t> end(first.begin(), first.end() - 1);
  for_edges(
      [&](std::size_t low, std::uint32_t use) { uses[end[low]++] = use; });
  // For the edges of one lesser end, by the other end: how many more go up.
  std::vector<std::int32_t> excess(count);
  for (std::size_t v = 0; v < count; ++v) {
    const auto of_vertex = std::span(uses).subspan(first[v], end[v] - first[v]);
    for (const std::uint32_t use : of_vertex)
      excess[use >> 1] += use % 2 == 0 ? 1 : -1;
    for (const std::uint32_t use : of_vertex) {
      if (excess[use >> 1] != 0) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<BadEdge> bad_edges(const Scene& scene) {
  if (is_closed_by_index(scene)) return {};
  std::vector<GridPoint> points;
  const auto places = places_of(scene.data().vertices, points);
  // The places of both ends, the lesser first, and whether the edge goes down:
  // put in order by the lesser end, and then those of one end, which are few.
  const auto for_uses = [&](const auto& visit) {
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const auto corners = scene.corners(static_cast<PolygonId>(p));
      std::uint64_t from = places[static_cast<std::size_t>(corners.back())];
      for (const VertexId corner : corners) {
        const std::uint64_t to = places[static_cast<std::size_t>(corner)];
        const auto [low, high] = std::minmax(from, to);
        visit(low, low << 33 | high << 1 | (from == low ? 0u : 1u));
        from = to;
      }
    }
  };
  std::vector<std::uint32_t> at(points.size() + 1);
  for_uses([&](std::uint64_t low, std::uint64_t) { ++at[low + 1]; });
  std::partial_sum(at.begin(), at.end(), at.begin());
  std::vector<std::uint64_t> uses(scene.data().corners.size());
  for_uses(
      [&](std::uint64_t low, std::uint64_t use) { uses[at[low]++] = use; });
  auto first = uses.begin();
  for (const std::uint32_t end : std::span(at).first(points.size())) {
    const auto last = uses.begin() + end;
    std::sort(first, last);
    first = last;
  }
  std::vector<BadEdge> bad;
  for (std::size_t i = 0; i < uses.size();) {
    const std::uint64_t ends = uses[i] >> 1;
    std::int64_t excess = 0;
    for (; i < uses.size() && uses[i] >> 1 == ends; ++i)
      excess += uses[i] % 2 == 0 ? 1 : -1;
    const GridPoint& low = points[ends >> 32];
    const GridPoint& high = points[ends & 0xffffffff];
    if (excess > 0) bad.push_back({low, high, excess});
    if (excess < 0) bad.push_back({high, low, -excess});
  }
  return bad;
}

Result<GridSolid> make_solid(Scene scene) {
  const std::vector<BadEdge> bad = bad_edges(scene);
  if (!bad.empty()) {
    const BadEdge& first = bad.front();
    return Error{ErrorCode::kOpen,
                 "the surface is not closed or not consistently oriented: " +
                     std::to_string(bad.size()) +
                     " bad edges, the first from " + text_of(first.from) +
                     " to " + text_of(first.to) + " (in grid steps)",
                 static_cast<std::int64_t>(bad.size())};
  }
  GridSolid solid;
  solid.scene_ = std::move(scene);
  return solid;
}

}  // namespace halfspace
