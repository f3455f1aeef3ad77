#include "halfspace/csg/closing.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/int128.hpp"

namespace halfspace::csg {
namespace {

/// A line: its direction, the least that there is, and the direction's cross
/// product with any of its points. 55 and 110 bits.
using Line = std::array<Int128, 6>;
using Ends = std::pair<GridPoint, GridPoint>;  ///< the lesser one first

Line line_through(const Ends& ends) {
  const auto& [p, q] = ends;
  const std::int64_t by = std::gcd(std::gcd(q.x - p.x, q.y - p.y), q.z - p.z);
  const Int128 x = (q.x - p.x) / by, y = (q.y - p.y) / by, z = (q.z - p.z) / by;
  return {x, y, z, y * p.z - z * p.y, z * p.x - x * p.z, x * p.y - y * p.x};
}

/// For each edge that is bad, the ends of others that lie within it, in order.
std::map<Ends, std::vector<GridPoint>> points_within(
    std::span<const BadEdge> bad) {
  std::vector<std::pair<Line, std::size_t>> on_line;  // and the bad edge
  on_line.reserve(bad.size());
  for (std::size_t i = 0; i < bad.size(); ++i) {
    on_line.emplace_back(line_through(std::minmax(bad[i].from, bad[i].to)), i);
  }
  std::sort(on_line.begin(), on_line.end());
  std::map<Ends, std::vector<GridPoint>> within;
  std::vector<GridPoint> points;
  for (std::size_t begin = 0, end = 0; begin < on_line.size(); begin = end) {
    while (end < on_line.size() && on_line[end].first == on_line[begin].first)
      ++end;
    // An edge by itself, as most are, has nothing within.
    if (end - begin == 1) continue;
    points.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const BadEdge& edge = bad[on_line[i].second];
      points.insert(points.end(), {edge.from, edge.to});
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (std::size_t i = begin; i < end; ++i) {
      const BadEdge& edge = bad[on_line[i].second];
      const Ends ends = std::minmax(edge.from, edge.to);
      const auto first =
          std::upper_bound(points.begin(), points.end(), ends.first);
      const auto last = std::lower_bound(first, points.end(), ends.second);
      if (first != last) within[ends] = {first, last};
    }
  }
  return within;
}

SceneData with_points(const Scene& scene,
                      const std::map<Ends, std::vector<GridPoint>>& within) {
  std::map<GridPoint, VertexId> ids;
  for (std::size_t v = 0; v < scene.data().vertices.size(); ++v)
    ids.emplace(scene.data().vertices[v], static_cast<VertexId>(v));
  SceneData data = scene.data();
  data.corners.clear();
  data.first_corner = {0};
  data.corner_colors.clear();
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      data.corners.push_back(corners[i]);
      const GridPoint& from = scene.point(corners[i]);
      const GridPoint& to = scene.point(corners[(i + 1) % corners.size()]);
      const auto at = within.find(std::minmax(from, to));
      if (at == within.end()) continue;
      const auto add = [&](const GridPoint& point) {
        data.corners.push_back(ids.at(point));
      };
      if (from < to)
        std::for_each(at->second.begin(), at->second.end(), add);
      else
        std::for_each(at->second.rbegin(), at->second.rend(), add);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
  }
  return data;
}

}  // namespace

ClosedScene split_on_lines(Scene scene) {
  const std::vector<BadEdge> bad = bad_edges(scene);
  if (bad.empty()) return {std::move(scene), 0};
  const auto within = points_within(bad);
  if (within.empty()) return {std::move(scene), 0};
  Result<Scene> split = make_scene(with_points(scene, within));
  if (!split) return {std::move(scene), 0};
  const std::size_t added =
      split->data().corners.size() - scene.data().corners.size();
  return {*std::move(split), added};
}

ClosedScene closed_on_lines(Scene scene) {
  ClosedScene split = split_on_lines(scene);
  if (split.added == 0 || !bad_edges(split.scene).empty())
    return {std::move(scene), 0};
  return split;
}

}  // namespace halfspace::csg
