#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "halfspace/polygon.hpp"

namespace halfspace {

/// A point or a vector of space. Units: model units.
struct Point {
  double x = 0;
  double y = 0;
  double z = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

/// A point of a plane. Units: model units.
struct Point2 {
  double x = 0;
  double y = 0;
  friend bool operator==(const Point2&, const Point2&) = default;
};

/// The least box with faces across the axes that holds something.
struct Bounds {
  Point low;
  Point high;
  friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// Where a polygon of a result comes from.
struct Origin {
  std::uint32_t operand = 0;  ///< index in Solid::operands()
  /// The polygon of that operand: of faces that were made one, the first; of a
  /// half-space 0.
  std::int32_t polygon = 0;
  friend bool operator==(const Origin&, const Origin&) = default;
};

/// Polygons in doubles: what goes into the library, and what comes out of it.
///
/// The corners of polygon `p` are `corners[first_corner[p]]` up to but not
/// including `corners[first_corner[p + 1]]`, counterclockwise as seen from
/// outside of a solid. Vertices that are equal are one point.
/// Shape: first_corner has one entry more than there are polygons, begins with
///        0, does not decrease and ends with corners.size(); colors, materials
///        and origins are empty or have one entry a polygon; fields is empty
///        or has field_count entries a corner.
struct Mesh {
  std::vector<Point> vertices = {};
  std::vector<std::uint32_t> first_corner = {0};
  std::vector<std::int32_t> corners = {};
  std::vector<Rgb> colors = {};
  /// Any number that polygons have in common; faces never merge across it.
  std::vector<std::int32_t> materials = {};
  /// Numbers at corners, such as texture coordinates, normals or temperatures:
  /// each is taken as affine over its polygon, by the first three corners that
  /// are not on a line.
  std::vector<double> fields = {};
  std::size_t field_count = 0;
  std::vector<Origin> origins = {};  ///< of results

  std::size_t polygon_count() const { return first_corner.size() - 1; }
  std::span<const std::int32_t> corners_of(std::size_t polygon) const {
    const std::size_t first = first_corner[polygon];
    return {corners.data() + first, first_corner[polygon + 1] - first};
  }
  /// The fields at a corner, of all polygons' corners in order.
  std::span<const double> fields_at(std::size_t corner) const {
    return {fields.data() + corner * field_count, field_count};
  }
  /// Adds a polygon of vertices that are there.
  Mesh& add(std::span<const std::int32_t> polygon) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    first_corner.push_back(static_cast<std::uint32_t>(corners.size()));
    return *this;
  }
  Mesh& add(std::initializer_list<std::int32_t> polygon) {
    return add(std::span<const std::int32_t>(polygon.begin(), polygon.size()));
  }
  friend bool operator==(const Mesh&, const Mesh&) = default;
};

}  // namespace halfspace
