#include "drawing/scene_edges.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "exact/cell_hash.hpp"
#include "exact/exact_plane.hpp"
#include "exact/gcd.hpp"

namespace halfspace::fast {
namespace {

/// A line of space: its direction without a common divisor, whose first
/// component that is not 0 is positive, and the moment p x direction of any
/// point p on it. Equal lines are equal numbers. Bits: 2n + 2 at most.
struct SpaceLine {
  Vector3<std::int64_t> direction;
  Vector3<Int128> moment;
  auto key() const {
    return std::tie(direction.x, direction.y, direction.z, moment.x, moment.y,
                    moment.z);
  }
};

SpaceLine line_through(const GridPoint& p, const GridPoint& q) {
  Vector3<std::int64_t> d = difference(p, q);
  std::uint64_t divisor = greatest_common_divisor(size_of(d.x), size_of(d.y));
  if (divisor != 1) divisor = greatest_common_divisor(divisor, size_of(d.z));
  auto by = static_cast<std::int64_t>(divisor);
  if ((d.x != 0 ? d.x : d.y != 0 ? d.y : d.z) < 0) by = -by;
  d = {d.x / by, d.y / by, d.z / by};
  return {d,
          {Int128{p.y} * d.z - Int128{p.z} * d.y,
           Int128{p.z} * d.x - Int128{p.x} * d.z,
           Int128{p.x} * d.y - Int128{p.y} * d.x}};
}

/// Sides between the same two vertices, and their line.
struct Bundle {
  SpaceLine line;
  std::uint64_t hash = 0;
  VertexId from = 0;  ///< before `to` along the line
  VertexId to = 0;
  int direction = 1;  ///< of the sides as they are listed
  std::size_t first = 0;
  std::size_t end = 0;
};

std::uint64_t hash_of_line(const SpaceLine& line) {
  const auto low = [](Int128 value) {
    return static_cast<std::uint64_t>(value);
  };
  return mixed(
      hash_of(low(line.direction.x), low(line.direction.y),
              low(line.direction.z)) *
          0x9e3779b97f4a7c15u +
      hash_of(low(line.moment.x), low(line.moment.y), low(line.moment.z)));
}

}  // namespace

SceneEdges::SceneEdges(const Scene& scene, const std::vector<bool>& present) {
  join_vertices(scene);
  std::vector<Side> sides;
  sides.reserve(scene.data().corners.size());
  for (PolygonId p = 0; p < static_cast<PolygonId>(present.size()); ++p) {
    if (!present[static_cast<std::size_t>(p)]) continue;
    const auto corners = scene.corners(p);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const VertexId a = first_of(corners[k]);
      const VertexId b = first_of(corners[k + 1 == corners.size() ? 0 : k + 1]);
      sides.push_back(a < b ? Side{a, b, {p, 1}} : Side{b, a, {p, -1}});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& f, const Side& g) {
    return std::tie(f.from, f.to, f.side.polygon) <
           std::tie(g.from, g.to, g.side.polygon);
  });
  divide_lines(scene, sides);
}

void SceneEdges::join_vertices(const Scene& scene) {
  const auto& points = scene.data().vertices;
  std::vector<VertexId> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto point = [&](VertexId v) -> const GridPoint& {
    return points[static_cast<std::size_t>(v)];
  };
  std::sort(order.begin(), order.end(), [&](VertexId u, VertexId v) {
    return point(u) != point(v) ? point(u) < point(v) : u < v;
  });
  first_.resize(points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool is_new = k == 0 || point(order[k]) != point(order[k - 1]);
    first_[static_cast<std::size_t>(order[k])] =
        is_new ? order[k] : first_[static_cast<std::size_t>(order[k - 1])];
  }
}

void SceneEdges::add(VertexId from, VertexId to, std::span<const Side> sides,
                     int direction) {
  for (const Side& side : sides) {
    sides_.push_back({side.side.polygon, side.side.direction * direction});
  }
  if (!edges_.empty() && edges_.back().from == from && edges_.back().to == to) {
    edges_.back().side_count += static_cast<std::uint32_t>(sides.size());
    return;
  }
  const auto count = static_cast<std::uint32_t>(sides.size());
  edges_.push_back(
      {from, to, static_cast<std::uint32_t>(sides_.size()) - count, count});
}

void SceneEdges::divide_lines(const Scene& scene,
                              const std::vector<Side>& sides) {
  std::vector<Bundle> bundles;
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t end = first + 1;
    while (end < sides.size() && sides[end].from == sides[first].from &&
           sides[end].to == sides[first].to)
      ++end;
    Bundle bundle;
    bundle.from = sides[first].from;
    bundle.to = sides[first].to;
    bundle.first = first;
    bundle.end = end;
    bundle.line =
        line_through(scene.point(bundle.from), scene.point(bundle.to));
    bundle.hash = hash_of_line(bundle.line);
    if (scene.point(bundle.to) < scene.point(bundle.from)) {
      std::swap(bundle.from, bundle.to);
      bundle.direction = -1;
    }
    bundles.push_back(bundle);
    first = end;
  }
  const auto before = [&](const Bundle& f, const Bundle& g) {
    if (f.hash != g.hash) return f.hash < g.hash;
    if (f.line.key() != g.line.key()) return f.line.key() < g.line.key();
    return scene.point(f.from) < scene.point(g.from);
  };
  std::sort(bundles.begin(), bundles.end(), before);
  // Along a line points are in the order of their coordinates.
  std::vector<VertexId> ends;
  std::vector<std::size_t> open;
  for (std::size_t first = 0; first < bundles.size();) {
    std::size_t end = first;
    ends.clear();
    while (end < bundles.size() && bundles[end].hash == bundles[first].hash &&
           bundles[end].line.key() == bundles[first].line.key()) {
      ends.push_back(bundles[end].from);
      ends.push_back(bundles[end].to);
      ++end;
    }
    std::sort(ends.begin(), ends.end(), [&](VertexId u, VertexId v) {
      return scene.point(u) < scene.point(v);
    });
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::size_t next = first;
    open.clear();
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const auto is_over = [&](std::size_t b) {
        return bundles[b].to == ends[k];
      };
      open.erase(std::remove_if(open.begin(), open.end(), is_over), open.end());
      while (next < end && bundles[next].from == ends[k])
        open.push_back(next++);
      for (const std::size_t b : open) {
        add(ends[k], ends[k + 1],
            std::span(sides).subspan(bundles[b].first,
                                     bundles[b].end - bundles[b].first),
            bundles[b].direction);
      }
    }
    first = end;
  }
  const auto by_vertices = [](const SceneEdge& f, const SceneEdge& g) {
    return std::tie(f.from, f.to) < std::tie(g.from, g.to);
  };
  std::sort(edges_.begin(), edges_.end(), by_vertices);
}

}  // namespace halfspace::fast
