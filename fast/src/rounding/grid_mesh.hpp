#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/polygon.hpp"

namespace halfspace::fast {

/// A triangle of a grid mesh, and the polygon that it comes from.
struct GridTriangle {
  std::array<std::int32_t, 3> corners{};
  std::int32_t source = 0;
  std::int32_t number = -1;  ///< in a MeshIndex; -1: it has none yet
};

/// `marked`: by point.
inline bool has_marked_corner(const GridTriangle& triangle,
                              const std::vector<std::uint8_t>& marked) {
  const auto& [a, b, c] = triangle.corners;
  return marked[static_cast<std::size_t>(a)] != 0 ||
         marked[static_cast<std::size_t>(b)] != 0 ||
         marked[static_cast<std::size_t>(c)] != 0;
}

/// An oriented surface of triangles between grid points. As a chain, it counts
/// a triangle as often as it is there.
struct GridMesh {
  std::vector<GridPoint> points;
  /// By point: whether it was moved since the surface was known to be a
  /// solid's.
  std::vector<std::uint8_t> moved;
  std::vector<GridTriangle> triangles;

  const GridPoint& at(std::int32_t p) const {
    return points[static_cast<std::size_t>(p)];
  }
  bool is_moved(std::int32_t p) const {
    return moved[static_cast<std::size_t>(p)] != 0;
  }
  bool is_moved(const GridTriangle& t) const {
    return has_marked_corner(t, moved);
  }
};

/// What clean() took away.
struct Collapse {
  std::size_t points = 0;     ///< that fell on others
  std::size_t triangles = 0;  ///< without area, or cancelled
};

/// Makes a closed surface with moved points one whose edges cancel again: equal
/// points become one, triangles without area go, and where that leaves a vertex
/// within an edge the triangles there are cut. Triangles and their reversals
/// cancel.
///
/// Requires: closed, edge by edge, as a chain.
/// Shape:    so is the result; no triangle of it is without area.
/// Keeps:    the chain, as that of triangles with an area.
Collapse clean(GridMesh& mesh);

/// Drops points that no triangle has.
void drop_unused_points(GridMesh& mesh);

}  // namespace halfspace::fast
