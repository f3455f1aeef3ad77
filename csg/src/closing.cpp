#include "halfspace/csg/closing.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
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

/// What lines that are the same have in common, as few others do.
std::uint64_t hash_of(const Line& line) {
  std::uint64_t hash = 0;
  for (const Int128& value : line) {
    for (const auto part : {static_cast<std::uint64_t>(value),
                            static_cast<std::uint64_t>(value >> 64)}) {
      hash = (hash ^ part) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
  }
  return hash;
}

using PointsWithin = std::map<Ends, std::vector<GridPoint>>;

/// Notes what is within the edges of one line.
void note_within(std::span<const Ends> edges, PointsWithin& within) {
  std::vector<GridPoint> points;
  for (const auto& [from, to] : edges) points.insert(points.end(), {from, to});
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const Ends& ends : edges) {
    const auto first =
        std::upper_bound(points.begin(), points.end(), ends.first);
    const auto last = std::lower_bound(first, points.end(), ends.second);
    if (first != last) within[ends] = {first, last};
  }
}

/// For each edge that is bad, the ends of others that lie within it, in order.
PointsWithin points_within(std::span<const BadEdge> bad) {
  const auto ends_of = [&](std::uint32_t edge) {
    return Ends(std::minmax(bad[edge].from, bad[edge].to));
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> hashes;
  hashes.reserve(bad.size());
  for (std::uint32_t i = 0; i < bad.size(); ++i)
    hashes.emplace_back(hash_of(line_through(ends_of(i))), i);
  std::sort(hashes.begin(), hashes.end());
  PointsWithin within;
  std::vector<std::pair<Line, Ends>> alike;
  std::vector<Ends> edges;
  for (std::size_t begin = 0, end = 0; begin < hashes.size(); begin = end) {
    while (end < hashes.size() && hashes[end].first == hashes[begin].first)
      ++end;
    // An edge by itself, as most are, has nothing within.
    if (end - begin == 1) continue;
    alike.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const Ends ends = ends_of(hashes[i].second);
      alike.emplace_back(line_through(ends), ends);
    }
    // Lines that are not the same may have one hash.
    std::sort(alike.begin(), alike.end());
    for (std::size_t i = 0; i < alike.size();) {
      edges.clear();
      const Line line = alike[i].first;
      for (; i < alike.size() && alike[i].first == line; ++i)
        edges.push_back(alike[i].second);
      note_within(edges, within);
    }
  }
  return within;
}

SceneData with_points(const Scene& scene, const PointsWithin& within) {
  std::map<GridPoint, VertexId> ids;  // of what is within something
  for (const auto& [ends, points] : within) {
    for (const GridPoint& point : points) ids.emplace(point, -1);
  }
  for (std::size_t v = 0; v < scene.data().vertices.size(); ++v) {
    const auto at = ids.find(scene.data().vertices[v]);
    if (at != ids.end() && at->second < 0)
      at->second = static_cast<VertexId>(v);
  }
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
  if (bad.empty()) return {std::move(scene), 0, false};
  const auto within = points_within(bad);
  if (within.empty()) return {std::move(scene), 0, true};
  Result<Scene> split = make_scene(with_points(scene, within));
  if (!split) return {std::move(scene), 0, true};
  const std::size_t added =
      split->data().corners.size() - scene.data().corners.size();
  const bool is_open = !bad_edges(*split).empty();
  return {*std::move(split), added, is_open};
}

ClosedScene closed_on_lines(Scene scene) {
  ClosedScene split = split_on_lines(scene);
  if (split.added == 0 || split.is_open)
    return {std::move(scene), 0, split.is_open};
  return split;
}

}  // namespace halfspace::csg
