#include "point_ranks.hpp"

#include <algorithm>
#include <numeric>

namespace halfspace::csg {

PointRanks point_ranks(const std::vector<GridPoint>& vertices) {
  struct Entry {
    GridPoint point;
    std::uint32_t vertex = 0;
  };
  std::vector<Entry> entries;
  entries.reserve(vertices.size());
  for (const GridPoint& point : vertices)
    entries.push_back({point, static_cast<std::uint32_t>(entries.size())});
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.point < b.point; });
  PointRanks ranks;
  ranks.of_vertex.resize(vertices.size());
  for (const Entry& entry : entries) {
    if (ranks.points.empty() || ranks.points.back() != entry.point)
      ranks.points.push_back(entry.point);
    ranks.of_vertex[entry.vertex] =
        static_cast<std::uint32_t>(ranks.points.size() - 1);
  }
  return ranks;
}

}  // namespace halfspace::csg
