#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "halfspace/int128.hpp"
#include "soup.hpp"

/// Holes of a soup, and what closes them.
namespace halfspace::csg {
namespace {

using Loop = std::vector<VertexId>;

/// Least-area triangles of loops with more corners would take too long: they
/// are left to import, which cuts any polygon.
constexpr std::size_t kMostCorners = 300;

DoublePoint cross(const DoublePoint& u, const DoublePoint& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
          u[0] * v[1] - u[1] * v[0]};
}

DoublePoint difference(const DoublePoint& p, const DoublePoint& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

double length(const DoublePoint& p) { return std::hypot(p[0], p[1], p[2]); }

/// The loops against the open edges, none of which visits a corner twice.
std::vector<Loop> loops_of(const Soup& soup) {
  std::multimap<VertexId, VertexId> next;
  for (const auto& [from, to] : open_edges(soup)) next.emplace(to, from);
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop path{next.begin()->first};
    while (true) {
      const auto at = next.find(path.back());
      if (at == next.end()) break;
      const VertexId to = at->second;
      next.erase(at);
      const auto seen = std::find(path.begin(), path.end(), to);
      if (seen == path.end()) {
        path.push_back(to);
        continue;
      }
      if (path.end() - seen >= 3) loops.emplace_back(seen, path.end());
      path.erase(seen + 1, path.end());
    }
  }
  return loops;
}

/// Whether all corners lie in one plane. Exact.
bool is_planar(const Soup& soup, const Loop& loop) {
  const GridPoint& o = soup.at(loop[0]);
  const auto arm = [&](VertexId v) {
    const GridPoint& p = soup.at(v);
    return std::array<io::Integer, 3>{
        io::Integer(p.x) - o.x, io::Integer(p.y) - o.y, io::Integer(p.z) - o.z};
  };
  std::array<io::Integer, 3> normal{};
  const auto u = arm(loop[1]);
  std::size_t i = 2;
  for (; i < loop.size(); ++i) {
    const auto v = arm(loop[i]);
    normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
              u[0] * v[1] - u[1] * v[0]};
    if (normal[0] != 0 || normal[1] != 0 || normal[2] != 0) break;
  }
  for (; i < loop.size(); ++i) {
    const auto v = arm(loop[i]);
    if (normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2] != 0)
      return false;
  }
  return true;
}

/// Triangles of the least area in all (KLI80; BS95), by the least of the parts
/// between each two corners.
std::vector<Loop> least_triangles(const Soup& soup, const Loop& loop) {
  const std::size_t n = loop.size();
  std::vector<double> least(n * n);
  std::vector<std::size_t> apex(n * n);
  std::vector<DoublePoint> at;
  for (const VertexId v : loop) at.push_back(in_doubles(soup.at(v)));
  for (std::size_t width = 2; width < n; ++width) {
    for (std::size_t i = 0; i + width < n; ++i) {
      const std::size_t k = i + width;
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t j = i + 1; j < k; ++j) {
        const double area =
            least[i * n + j] + least[j * n + k] +
            length(cross(difference(at[j], at[i]), difference(at[k], at[i])));
        if (area >= best) continue;
        best = area;
        apex[i * n + k] = j;
      }
      least[i * n + k] = best;
    }
  }
  std::vector<Loop> triangles;
  std::vector<std::pair<std::size_t, std::size_t>> parts{{0, n - 1}};
  while (!parts.empty()) {
    const auto [i, k] = parts.back();
    parts.pop_back();
    if (k < i + 2) continue;
    const std::size_t j = apex[i * n + k];
    triangles.push_back({loop[i], loop[j], loop[k]});
    parts.insert(parts.end(), {{i, j}, {j, k}});
  }
  return triangles;
}

struct Extent {
  GridPoint low, high;
  bool is_empty = true;
  void add(const GridPoint& p) {
    if (is_empty) low = high = p;
    is_empty = false;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y),
            std::max(high.z, p.z)};
  }
  std::int64_t width() const {
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  }
};

/// By point, the extent of what hangs together with it by corners.
class Extents {
 public:
  explicit Extents(const Soup& soup) : parent_(soup.points.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const auto& polygon : soup.polygons) {
      for (const VertexId v : polygon)
        parent_[root(v)] = static_cast<VertexId>(root(polygon[0]));
    }
    extents_.resize(soup.points.size());
    for (const auto& polygon : soup.polygons) {
      for (const VertexId v : polygon) extents_[root(v)].add(soup.at(v));
    }
  }
  const Extent& of(VertexId v) { return extents_[root(v)]; }

 private:
  std::size_t root(VertexId v) {
    auto at = static_cast<std::size_t>(v);
    while (parent_[at] != static_cast<VertexId>(at)) {
      const auto up = static_cast<std::size_t>(parent_[at]);
      parent_[at] = parent_[up];
      at = up;
    }
    return at;
  }

  std::vector<VertexId> parent_;
  std::vector<Extent> extents_;
};

}  // namespace

Filled fill_holes(Soup& soup, bool all) {
  Filled filled;
  Extents extents(soup);
  // What fills a hole counts as a part of a polygon beside it.
  std::map<VertexId, std::size_t> polygon_at;
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    for (const VertexId v : soup.polygons[p]) polygon_at.emplace(v, p);
  }
  for (const Loop& loop : loops_of(soup)) {
    Extent extent;
    for (const VertexId v : loop) extent.add(soup.at(v));
    if (!all && extent.width() >= extents.of(loop[0]).width() / 2) {
      if (loop.size() <= filled.left_edges) continue;
      filled.left_edges = loop.size();
      filled.left_at = soup.at(loop[0]);
      continue;
    }
    const std::size_t beside = polygon_at.at(loop[0]);
    const auto add = [&](const Loop& polygon) {
      soup.add(polygon, soup.sources[beside], soup.colors[beside]);
      ++filled.polygons;
    };
    if (loop.size() > 3 && !is_planar(soup, loop)) {
      ++filled.others;
      if (loop.size() > kMostCorners) {
        add(loop);
        continue;
      }
      for (const Loop& triangle : least_triangles(soup, loop)) add(triangle);
      continue;
    }
    ++filled.planar;
    add(loop);
  }
  return filled;
}

}  // namespace halfspace::csg
