#pragma once

#include <initializer_list>
#include <map>
#include <span>

#include "halfspace/scene.hpp"

namespace halfspace::models {

/// The sum of two points, as vectors.
constexpr GridPoint operator+(const GridPoint& a, const GridPoint& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr GridPoint operator-(const GridPoint& a, const GridPoint& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr GridPoint operator*(std::int64_t k, const GridPoint& a) {
  return {k * a.x, k * a.y, k * a.z};
}

/// Collects polygons; equal points become one vertex.
class Builder {
 public:
  /// Adds the polygon with these corners, counterclockwise seen from outside,
  /// its colour lit by a directional light.
  /// Requires: its first three corners are not on one line.
  void add(std::span<const GridPoint> corners, Rgb color);
  void add(std::initializer_list<GridPoint> corners, Rgb color) {
    add(std::span(corners.begin(), corners.size()), color);
  }

  /// Adds the parallelepiped at `origin` with edges `u`, `v`, `w`, faces
  /// outwards, its edges cut into `parts_u`, `parts_v` and `parts_w` parts.
  /// Requires: (u x v).w > 0; every part has integer coordinates.
  void add_box(const GridPoint& origin, const GridPoint& u, const GridPoint& v,
               const GridPoint& w, Rgb color, std::int64_t parts_u = 1,
               std::int64_t parts_v = 1, std::int64_t parts_w = 1);

  /// Gives every corner the colour of its height, for smooth shading.
  /// Requires: triangles only.
  void color_corners_by_height();

  /// The scene with these polygons, its unit `2^exponent`.
  Result<Scene> scene(int exponent = 0) &&;

 private:
  void add_face(const GridPoint& origin, const GridPoint& u, const GridPoint& v,
                std::int64_t parts_u, std::int64_t parts_v, Rgb color);

  std::map<GridPoint, VertexId> vertices_;
  SceneData data_;
};

/// The colour number `index` of a fixed set in which neighbours differ.
Rgb palette(std::size_t index);

/// The colour between blue (0) and red (1).
Rgb heat(double share);

}  // namespace halfspace::models
