#include "halfspace/csg/closing.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "exact/repeats.hpp"
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

/// The integers modulo a prime of 61 bits, so that differences of coordinates
/// that are not zero are not zero there either.
constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;

std::uint64_t residue(std::int64_t value) {
  return value >= 0 ? static_cast<std::uint64_t>(value)
                    : kPrime - static_cast<std::uint64_t>(-value);
}

__extension__ typedef unsigned __int128 UInt128;

std::uint64_t times(std::uint64_t x, std::uint64_t y) {
  const UInt128 product = UInt128{x} * y;
  const std::uint64_t sum = (static_cast<std::uint64_t>(product) & kPrime) +
                            static_cast<std::uint64_t>(product >> 61);
  return sum >= kPrime ? sum - kPrime : sum;
}

std::uint64_t minus(std::uint64_t x, std::uint64_t y) {
  return x >= y ? x - y : x + kPrime - y;
}

/// By Fermat: to the power of the prime less 2.
std::uint64_t inverse(std::uint64_t x) {
  std::uint64_t power = 1;
  for (int bit = 60; bit >= 0; --bit) {
    power = times(power, power);
    if (((kPrime - 2) >> bit & 1) != 0) power = times(power, x);
  }
  return power;
}

/// A direction that is not zero and a point, in residues: first the axis along
/// which the direction is not zero, then the two others.
struct Residues {
  std::array<std::uint64_t, 3> direction;
  std::array<std::uint64_t, 3> point;
  std::uint64_t axis = 0;
};

Residues residues_of(const Ends& ends) {
  const auto& [p, q] = ends;
  const std::array<std::int64_t, 3> d = {q.x - p.x, q.y - p.y, q.z - p.z};
  const std::array<std::int64_t, 3> at = {p.x, p.y, p.z};
  const std::size_t axis = d[0] != 0 ? 0 : d[1] != 0 ? 1 : 2;
  Residues residues;
  residues.axis = axis;
  for (std::size_t k = 0; k < 3; ++k) {
    residues.direction[k] = residue(d[(axis + k) % 3]);
    residues.point[k] = residue(at[(axis + k) % 3]);
  }
  return residues;
}

/// Of edges' lines what those that are the same have in common, as few others
/// do: their slopes and where they meet the plane of two axes, in residues. All
/// inverses come from one, that of the product (Montgomery's way).
std::vector<std::uint64_t> line_hashes(std::span<const BadEdge> edges) {
  const auto residues = [&](std::size_t i) {
    return residues_of({edges[i].from, edges[i].to});
  };
  std::vector<std::uint64_t> hashes(edges.size());
  std::uint64_t product = 1;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    hashes[i] = product;
    product = times(product, residues(i).direction[0]);
  }
  std::uint64_t rest = inverse(product);
  for (std::size_t i = edges.size(); i-- > 0;) {
    const auto [direction, point, axis] = residues(i);
    const std::uint64_t by = times(rest, hashes[i]);
    rest = times(rest, direction[0]);
    hashes[i] = axis;
    for (std::size_t k = 1; k < 3; ++k) {
      const std::uint64_t slope = times(direction[k], by);
      const std::uint64_t start = minus(point[k], times(slope, point[0]));
      hashes[i] = spread(spread(hashes[i] + slope) + start);
    }
  }
  return hashes;
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
  // An edge by itself on its line, as most are, has nothing within.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> hashes;
  const std::vector<std::uint64_t> of_edge = line_hashes(bad);
  const std::vector<bool> is_suspect = may_repeat(of_edge);
  for (std::uint32_t i = 0; i < bad.size(); ++i) {
    if (is_suspect[i]) hashes.emplace_back(of_edge[i], i);
  }
  std::sort(hashes.begin(), hashes.end());
  PointsWithin within;
  std::vector<std::pair<Line, Ends>> alike;
  std::vector<Ends> edges;
  for (std::size_t begin = 0, end = 0; begin < hashes.size(); begin = end) {
    while (end < hashes.size() && hashes[end].first == hashes[begin].first)
      ++end;
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

std::optional<ClosedScene> split_on_lines(const Scene& scene,
                                          std::span<const BadEdge> bad) {
  const auto within = points_within(bad);
  if (within.empty()) return std::nullopt;
  Result<Scene> split = make_scene(with_points(scene, within));
  if (!split) return std::nullopt;
  const std::size_t added =
      split->data().corners.size() - scene.data().corners.size();
  const bool is_open = !bad_edges(*split).empty();
  return ClosedScene{*std::move(split), added, is_open};
}

ClosedScene split_on_lines(Scene scene) {
  const std::vector<BadEdge> bad = bad_edges(scene);
  if (auto split = split_on_lines(scene, bad)) return *std::move(split);
  return {std::move(scene), 0, !bad.empty()};
}

bool stays_open_on_lines(std::span<const BadEdge> bad) {
  // Where the edges of a line cancel, as many end at each point as begin there.
  const auto cancels = [&](const GridPoint& at, const Line& line) {
    std::int64_t excess = 0;
    for (const BadEdge& edge : bad) {
      if (edge.from != at && edge.to != at) continue;
      if (line_through(std::minmax(edge.from, edge.to)) != line) continue;
      excess += edge.from == at ? edge.excess : -edge.excess;
    }
    return excess == 0;
  };
  // A few will do: it is for surfaces that are open all over.
  constexpr std::size_t kTries = 4;
  for (std::size_t i = 0; i < kTries && !bad.empty(); ++i) {
    const BadEdge& edge = bad[i * (bad.size() - 1) / (kTries - 1)];
    if (!cancels(edge.from, line_through(std::minmax(edge.from, edge.to))))
      return true;
  }
  return false;
}

ClosedScene closed_on_lines(Scene scene) {
  const std::vector<BadEdge> bad = bad_edges(scene);
  if (bad.empty() || stays_open_on_lines(bad))
    return {std::move(scene), 0, !bad.empty()};
  auto split = split_on_lines(scene, bad);
  if (!split || split->is_open) return {std::move(scene), 0, true};
  return *std::move(split);
}

}  // namespace halfspace::csg
