#include "rounding/mesh_polygons.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "rounding/grid_predicates.hpp"

namespace halfspace::fast {
namespace {

/// Joins the triangles of one source.
class PolygonJoiner {
 public:
  PolygonJoiner(const GridMesh& mesh, std::span<const GridTriangle> triangles)
      : mesh_(mesh), parent_(triangles.size()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (const GridTriangle& t : triangles)
      loops_.push_back({t.corners.begin(), t.corners.end()});
  }

  /// Joins what it can, one edge after another, and calls `found(corners)` for
  /// what is left.
  template <class Found>
  void run(Found&& found) {
    std::vector<Edge> edges;
    for (std::size_t t = 0; t < loops_.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i)
        edges.push_back({loops_[t][i], loops_[t][(i + 1) % 3], t});
    }
    std::sort(edges.begin(), edges.end());
    for (const Edge& edge : edges) {
      if (edge.from > edge.to) continue;
      const auto back = std::lower_bound(edges.begin(), edges.end(),
                                         Edge{edge.to, edge.from, 0});
      if (back != edges.end() && back->from == edge.to && back->to == edge.from)
        join(edge, root(back->triangle));
    }
    for (std::size_t t = 0; t < loops_.size(); ++t) {
      if (parent_[t] == t) found(std::move(loops_[t]));
    }
  }

 private:
  using Loop = std::vector<std::int32_t>;
  struct Edge {
    std::int32_t from;
    std::int32_t to;
    std::size_t triangle;
    auto operator<=>(const Edge&) const = default;
  };

  std::size_t root(std::size_t t) const {
    while (parent_[t] != t) t = parent_[t];
    return t;
  }

  /// The place of a corner in a loop that has it once; the size where it has
  /// the corner twice or not at all.
  static std::size_t place_of(const Loop& loop, std::int32_t corner) {
    const auto first = std::find(loop.begin(), loop.end(), corner);
    if (first == loop.end() ||
        std::find(first + 1, loop.end(), corner) != loop.end())
      return loop.size();
    return static_cast<std::size_t>(first - loop.begin());
  }

  /// Whether the corner of `a` and that of `b` turn the same way as the loop
  /// does at its first corner, seen along an axis, and not by nothing.
  bool turns_left(std::int32_t before, std::int32_t at,
                  std::int32_t after) const {
    return turn_ ==
           turn_along(axis_, mesh_.at(before), mesh_.at(at), mesh_.at(after));
  }

  /// Notes how the loop turns, seen along an axis along which it has an area.
  void choose_axis(const Loop& loop) {
    for (axis_ = 0; axis_ < 3; ++axis_) {
      turn_ = turn_along(axis_, mesh_.at(loop[0]), mesh_.at(loop[1]),
                         mesh_.at(loop[2]));
      if (turn_ != 0) return;
    }
  }

  /// Joins the loops on both sides of an edge, if that is convex.
  void join(const Edge& edge, std::size_t with) {
    const std::size_t own = root(edge.triangle);
    if (own == with) return;
    Loop a = loops_[own], b = loops_[with];
    const std::size_t at_a = place_of(a, edge.from),
                      to_a = place_of(a, edge.to);
    const std::size_t at_b = place_of(b, edge.to),
                      to_b = place_of(b, edge.from);
    if (at_a == a.size() || (at_a + 1) % a.size() != to_a || at_b == b.size() ||
        (at_b + 1) % b.size() != to_b)
      return;
    // The edge's end first and its beginning last, in both.
    std::rotate(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(to_a),
                a.end());
    std::rotate(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(to_b),
                b.end());
    choose_axis(a);
    if (!turns_left(a[a.size() - 2], edge.from, b[1]) ||
        !turns_left(b[b.size() - 2], edge.to, a[1]))
      return;
    for (std::size_t i = 1; i + 1 < b.size(); ++i) {
      if (side_of_triangle(mesh_.at(a[0]), mesh_.at(a[1]), mesh_.at(a[2]),
                           mesh_.at(b[i])) != 0)
        return;
    }
    a.insert(a.end(), b.begin() + 1, b.end() - 1);
    const std::size_t to = std::min(own, with);
    parent_[std::max(own, with)] = to;
    loops_[to] = std::move(a);
  }

  const GridMesh& mesh_;
  std::vector<std::size_t> parent_;
  std::vector<Loop> loops_;
  int axis_ = 0;
  int turn_ = 0;
};

}  // namespace

std::vector<MeshPolygon> polygons_of(GridMesh& mesh) {
  const auto before = [](const GridTriangle& x, const GridTriangle& y) {
    return x.source < y.source;
  };
  auto& all = mesh.triangles;
  if (!std::is_sorted(all.begin(), all.end(), before))
    std::stable_sort(all.begin(), all.end(), before);
  std::vector<MeshPolygon> polygons;
  for (std::size_t t = 0; t < all.size();) {
    const std::int32_t source = all[t].source;
    std::size_t end = t + 1;
    while (end < all.size() && all[end].source == source) ++end;
    const auto add = [&](std::vector<std::int32_t> corners) {
      polygons.push_back({std::move(corners), source});
    };
    if (end == t + 1) {
      add({all[t].corners.begin(), all[t].corners.end()});
    } else {
      PolygonJoiner(mesh, std::span(all).subspan(t, end - t)).run(add);
    }
    t = end;
  }
  return polygons;
}

}  // namespace halfspace::fast
