#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

/// The length of one grid step in model units: `base` to the `exponent`
/// (S1.1). Base 10 keeps decimal text exact, base 2 keeps binary floats exact.
struct Unit {
  std::int32_t base = 2;      ///< 2 or 10
  std::int32_t exponent = 0;  ///< -4096 to 4096
  friend bool operator==(const Unit&, const Unit&) = default;
};

/// The grids (S1.1): coordinates are signed integers of 26, 40 or 54 bits.
constexpr int kGridBits[] = {26, 40, 54};

/// Whether `coordinate` is a signed integer of `bits` bits.
constexpr bool fits(std::int64_t coordinate, int bits) {
  const std::int64_t limit = std::int64_t{1} << (bits - 1);
  return -limit <= coordinate && coordinate < limit;
}

/// The data of a scene, not yet checked.
///
/// The corners of polygon `p` are `corners[first_corner[p]]` up to but not
/// including `corners[first_corner[p + 1]]`.
/// Shape: first_corner has one entry more than there are polygons, begins with
///        0, does not decrease and ends with corners.size(); colors has one
///        entry a polygon; corner_colors is empty or has one entry a corner.
struct SceneData {
  Unit unit;
  int grid_bits = 26;
  std::vector<GridPoint> vertices;
  std::vector<std::uint32_t> first_corner = {0};
  std::vector<VertexId> corners;
  std::vector<Rgb> colors;         ///< for flat shading
  std::vector<Rgb> corner_colors;  ///< for Gouraud shading
  friend bool operator==(const SceneData&, const SceneData&) = default;
};

/// A valid scene (S1.2): only make_scene() makes one.
class Scene {
 public:
  /// The empty scene.
  Scene() = default;

  const SceneData& data() const { return data_; }
  Unit unit() const { return data_.unit; }
  int grid_bits() const { return data_.grid_bits; }
  std::size_t polygon_count() const { return data_.first_corner.size() - 1; }

  /// The vertices of a polygon in order, as indices. Shape: 3 or more.
  std::span<const VertexId> corners(PolygonId polygon) const {
    const auto p = static_cast<std::size_t>(polygon);
    const std::size_t first = data_.first_corner[p];
    return {data_.corners.data() + first, data_.first_corner[p + 1] - first};
  }
  const GridPoint& point(VertexId vertex) const {
    return data_.vertices[static_cast<std::size_t>(vertex)];
  }
  Rgb color(PolygonId polygon) const {
    return data_.colors[static_cast<std::size_t>(polygon)];
  }
  /// The colours at the corners of a polygon; empty where the scene has none.
  std::span<const Rgb> corner_colors(PolygonId polygon) const {
    if (data_.corner_colors.empty()) return {};
    const auto p = static_cast<std::size_t>(polygon);
    const std::size_t first = data_.first_corner[p];
    return {data_.corner_colors.data() + first,
            data_.first_corner[p + 1] - first};
  }
  friend bool operator==(const Scene&, const Scene&) = default;

 private:
  friend Result<Scene> make_scene(SceneData data);
  SceneData data_;
};

/// The scene that `data` describes, if it is valid (S1.2, S1.3).
///
/// A polygon is convex and exactly planar with at least 3 vertices and
/// non-zero area; corners of 180 degrees are allowed, repeated points are not.
/// Exact:  yes: 128-bit integers below 54 bits of grid, 256 above.
/// Errors: the first that holds, polygon by polygon: kBadIndex,
///         kTooFewVertices, kRepeatedVertex, kZeroArea, kNotPlanar,
///         kNotConvex, kNotTriangle, with the polygon's index; before those,
///         kOutOfRange (a coordinate beyond grid_bits, with the vertex's
///         index; more than 2^31 - 1 of anything; an unknown grid or unit).
/// Cost:   linear in the number of corners.
Result<Scene> make_scene(SceneData data);

/// The smallest of 26, 40 and 54 that holds every coordinate; 0 if none does.
int grid_bits_for(std::span<const GridPoint> vertices);

}  // namespace halfspace
