#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bounded.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::shadow {

/// A point of space in the camera's coordinates: eye + X sx + Y sy + T (s0 -
/// eye), or s0 + X sx + Y sy - T eye; W is T, or 1. It is shown at (X/W, Y/W).
struct Projected {
  Bounded x, y, w, t;
  double column = 0;  ///< X/W, to less than a pixel, if that is known
  double row = 0;     ///< Y/W likewise
  bool is_placed = false;
};

/// Columns and rows of pixels, ends included.
struct Bounds {
  std::int32_t left = 0, right = -1, top = 0, bottom = -1;
  bool is_empty() const { return left > right || top > bottom; }
};

/// The function c + x dx + y dy of the image point.
struct Affine {
  Bounded c, dx, dy;
  Bounded at(double x, double y) const {
    return c + exactly(x) * dx + exactly(y) * dy;
  }
};

/// What is certain.
enum class Verdict : std::uint8_t { kNo, kYes, kUnknown };

/// A polygon as the pixels see it.
struct Prepared {
  /// The sample is covered where all of its inside functions are positive
  /// (S4.5), near included: from this one of Polygons::insides_ on, so many.
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  /// nearness / scale is 1/T in perspective, else -T: the greater, the nearer.
  Affine nearness;
  Bounded scale;         ///< positive
  bool certain = false;  ///< false: nothing is known of it
};

/// The polygons of a scene before a camera, as far as doubles tell.
class Polygons {
 public:
  Polygons(const Scene& scene, const Camera& camera,
           const ImageOptions& options);

  /// Pixels that may see the polygon: no other can. Empty where it covers none.
  Bounds bounds_of(PolygonId polygon) const;

  Prepared prepare(PolygonId polygon);

  /// Whether the centre of pixel (i, j) is within the polygon.
  Verdict covers(const Prepared& polygon, std::int32_t i, std::int32_t j) const;

  /// Whether one is certainly nearer than the other at the centre.
  static bool is_nearer(const Prepared& one, const Prepared& other,
                        std::int32_t i, std::int32_t j);

  /// Whether the polygon, a triangle, certainly has this Gouraud colour at the
  /// centre (S5.4).
  bool has_color(PolygonId polygon, const Prepared& prepared, std::int32_t i,
                 std::int32_t j, Rgb color) const;

 private:
  Projected project(const GridPoint& p) const;

  const Scene& scene_;
  const Camera& camera_;
  bool cull_;
  LatticeVector origin_;
  Bounded rows_[3][3];  ///< X, Y and T from the point less the origin
  Bounded volume_;      ///< of sx, sy and the depth
  std::vector<Projected> vertices_;
  std::vector<Affine> insides_;
};

}  // namespace halfspace::shadow
