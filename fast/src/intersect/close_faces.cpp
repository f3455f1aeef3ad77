#include "intersect/close_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "intersect/flat_stars.hpp"

namespace halfspace::fast {
namespace {

/// Faces of more edges are searched by packets of them (FaceIntersector).
constexpr std::uint32_t kMostEdges = 24;

/// An interval of a line that holds the exact one.
struct Interval {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  void add(const Vertex& v, int axis) {
    low = std::min(low, coordinate(v, axis) - v.error);
    high = std::max(high, coordinate(v, axis) + v.error);
  }
};

/// The corners that both have come first. Returns how many.
std::size_t match(std::array<std::int32_t, 3>& p,
                  std::array<std::int32_t, 3>& q) {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = shared; j < 3; ++j) {
      if (p[i] != q[j]) continue;
      std::swap(p[i], p[shared]);
      std::swap(q[j], q[shared]);
      ++shared;
      break;
    }
  }
  return shared;
}

}  // namespace

bool CloseFaces::is_triangle(std::int32_t f) const {
  if (face(f).edge_count != 3) return false;
  const SolidEdge* e = edges_of(f);
  return e[0].to == e[1].from && e[1].to == e[2].from && e[2].to == e[0].from;
}

bool CloseFaces::only_share_corners(std::int32_t f, std::int32_t g) const {
  if (is_triangle(f) && is_triangle(g)) return triangles_only_share(f, g);
  if (face(f).plane == face(g).plane) return false;
  return is_beside(f, g) || is_beside(g, f);
}

/// Whether face `g` is on one side of the plane of `f`, but for corners and
/// edges that both have.
bool CloseFaces::is_beside(std::int32_t g, std::int32_t f) const {
  const std::uint32_t count = face(g).edge_count;
  if (count == 0 || count > kMostEdges || face(f).edge_count > kMostEdges ||
      face(f).edge_count == 0)
    return false;
  const SolidEdge* edges = edges_of(g);
  const auto is_corner = [&](std::int32_t v) {
    const SolidEdge* first = edges_of(f);
    return std::any_of(first, first + face(f).edge_count,
                       [v](const SolidEdge& e) { return e.from == v; });
  };
  int all = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const int side = table_.side(face(f).plane, edges[i].from);
    if (side * all < 0) return false;
    if (side != 0) {
      all = side;
      continue;
    }
    if (!is_corner(edges[i].from)) return false;
    if (table_.side(face(f).plane, edges[i].to) == 0 &&
        edges_.neighbour(face(g).first_edge + i) != f)
      return false;
  }
  return all != 0;
}

bool CloseFaces::triangles_only_share(std::int32_t f, std::int32_t g) const {
  Corners p, q;
  for (std::size_t i = 0; i < 3; ++i) {
    p.at[i] = edges_of(f)[i].from;
    q.at[i] = edges_of(g)[i].from;
  }
  const std::size_t shared = match(p.at, q.at);
  if (shared == 3) return false;
  if (shared == 2) {
    // Both reach the line of the edge there alone, unless in one plane.
    const auto is_theirs = [&](std::uint32_t i) {
      return edges_.neighbour(face(f).first_edge + i) == g;
    };
    if (!is_theirs(0) && !is_theirs(1) && !is_theirs(2)) return false;
    return face(f).plane != face(g).plane || face(f).flipped == face(g).flipped;
  }
  if (face(f).plane == face(g).plane) return coplanar_only_share(f, p, q);
  const auto find_sides = [&](Corners& corners, std::int32_t plane) {
    for (std::size_t i = 0; i < 3; ++i)
      corners.side[i] = i < shared ? 0 : table_.side(plane, corners.at[i]);
  };
  const auto one_side = [&](const Corners& c) {
    const auto [low, high] = std::minmax_element(c.side.begin(), c.side.end());
    return *low >= 0 || *high <= 0;
  };
  for (const bool first : {true, false}) {
    const std::int32_t plane = face(first ? f : g).plane;
    Corners& c = first ? q : p;
    find_sides(c, plane);
    if (!one_side(c)) continue;
    std::array<std::int32_t, 3> on{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (c.side[i] == 0) on[count++] = c.at[i];
    }
    if (count == shared) return true;
    return is_apart_in_plane(plane, first ? p : q, std::span(on).first(count));
  }
  return crossing_only_share(f, g, shared, p, q);
}

/// Triangles in one plane, with at most one common corner.
bool CloseFaces::coplanar_only_share(std::int32_t f, const Corners& p,
                                     const Corners& q) const {
  return is_apart_in_plane(face(f).plane, p, q.at) ||
         is_apart_in_plane(face(f).plane, q, p.at);
}

/// Triangles that each reach both sides of the other's plane: whether the parts
/// of the planes' common line that they have are apart, or end in opposite
/// directions at the corner that they share.
bool CloseFaces::crossing_only_share(std::int32_t f, std::int32_t g,
                                     std::size_t shared, const Corners& p,
                                     const Corners& q) const {
  int axis = 0;
  if (!table_.line_axis(face(f).plane, face(g).plane, axis)) return false;
  const double r = table_.rounding();
  const auto part = [&](const Corners& c, std::int32_t plane_id) {
    const FilterPlane& plane = table_.plane(plane_id).filter;
    Interval interval;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const Vertex& u = table_.vertex(c.at[i]).approximate;
      const Vertex& v = table_.vertex(c.at[j]).approximate;
      if (c.side[i] == 0 && i >= shared) interval.add(u, axis);
      if (c.side[i] * c.side[j] >= 0) continue;
      interval.add(
          fast::meet(u, value_at(plane, u, r), v, value_at(plane, v, r), r),
          axis);
    }
    return interval;
  };
  const Interval a = part(p, face(g).plane);
  const Interval b = part(q, face(f).plane);
  if (shared == 0) return a.high < b.low || b.high < a.low;
  const Vertex& at = table_.vertex(p.at[0]).approximate;
  const double low = coordinate(at, axis) - at.error;
  const double high = coordinate(at, axis) + at.error;
  return (a.high < low && b.low > high) || (b.high < low && a.low > high);
}

/// Whether the hull of points in a triangle's plane has nothing in common with
/// it but a corner, as some line along an edge of either shows.
bool CloseFaces::is_apart_in_plane(std::int32_t plane, const Corners& p,
                                   std::span<const std::int32_t> points) const {
  const Plane& n = table_.plane(plane).filter.plane;
  const std::array<double, 3> size{std::abs(n.a), std::abs(n.b), std::abs(n.c)};
  const auto axis = static_cast<int>(
      std::max_element(size.begin(), size.end()) - size.begin());
  const int turn = table_.turn(axis, p.at[0], p.at[1], p.at[2]);
  if (turn == 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (line_parts(axis, p.at[i], p.at[(i + 1) % 3], -turn, points))
      return true;
  }
  if (points.size() != 2) return false;
  return line_parts(axis, points[0], points[1], 1, p.at) ||
         line_parts(axis, points[0], points[1], -1, p.at);
}

/// Whether all points are on one side of the line through two corners, and
/// those on it beyond them, or at a corner of both.
bool CloseFaces::line_parts(int axis, std::int32_t u, std::int32_t v, int side,
                            std::span<const std::int32_t> points) const {
  std::array<std::int32_t, 3> on{};
  std::size_t count = 0;
  for (const std::int32_t point : points) {
    const int turn =
        point == u || point == v ? 0 : table_.turn(axis, u, v, point);
    if (turn * side < 0) return false;
    if (turn == 0) on[count++] = point;
  }
  if (count == 0) return true;
  const int along = table_.edge_axis(u, v);
  const auto is_less = [&](std::int32_t s, std::int32_t t) {
    return s != t && table_.compare(along, s, t) < 0;
  };
  const auto [low, high] = std::minmax(u, v, is_less);
  const auto [first, last] =
      std::minmax_element(on.begin(), on.begin() + count, is_less);
  return is_less(*last, low) || is_less(high, *first) || *last == low ||
         *first == high;
}

FacePairs undecided_pairs(const Solid& solid, const GeometryTable& table,
                          const SurfaceEdges& edges, const DynamicBvh& index,
                          const CheckOptions& options) {
  const CloseFaces close(solid, table, edges);
  const FlatStars stars(solid, edges.is_closed());
  FacePairs pairs;
  const BoxTree* const tree = index.whole();
  const std::size_t count = tree != nullptr ? tree->packet_count() : 0;
  constexpr std::size_t kBlock = 64;
  // Progress is shown between parts: whoever shows it has one thread.
  constexpr std::size_t kPart = 64 * kBlock;
  for (std::size_t begin = 0; begin < count; begin += kPart) {
    if (options.progress && !options.progress(static_cast<double>(begin) /
                                              static_cast<double>(count)))
      break;
    const std::size_t size = std::min(kPart, count - begin);
    std::vector<FacePairs> found((size + kBlock - 1) / kBlock);
    for_blocks(thread_count(options.threads), size, kBlock,
               [&](std::size_t number, std::size_t first, std::size_t last) {
                 for (std::size_t i = begin + first; i < begin + last; ++i) {
                   tree->for_items(i + 2,
                                   [&](std::int32_t f) { stars.prefetch(f); });
                   tree->for_items(
                       i + 1, [&](std::int32_t f) { stars.prefetch_plane(f); });
                   tree->find_pairs(i, [&](std::int32_t f, std::int32_t g) {
                     if (stars.settle(f, g)) return;
                     if (f > g) std::swap(f, g);
                     if (!close.only_share_corners(f, g))
                       found[number].emplace_back(f, g);
                   });
                 }
               });
    for (const FacePairs& some : found)
      pairs.insert(pairs.end(), some.begin(), some.end());
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace halfspace::fast
