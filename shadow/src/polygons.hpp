#pragma once

#include <cmath>
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
  /// No less than 1/T in perspective, else than -T.
  double nearness = HUGE_VAL;
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
};

/// The same with one bound for all pixels' centres: less to keep, and to do.
struct Plain {
  double c = 0, dx = 0, dy = 0;
  double error = HUGE_VAL;

  double value_at(double x, double y) const { return c + x * dx + y * dy; }
  Bounded at(double x, double y) const { return {value_at(x, y), error}; }
};

/// What is certain.
enum class Verdict : std::uint8_t { kNo, kYes, kUnknown };

/// A polygon as the pixels see it.
struct Prepared {
  /// The sample is covered where all of its inside functions are positive
  /// (S4.5), near included: from this one of Polygons::insides_ on, so many.
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Plain nearness;        ///< 1/T in perspective, else -T
  bool certain = false;  ///< false: nothing is known of it
};

/// The polygons of a scene before a camera, as far as doubles tell.
class Polygons {
 public:
  Polygons(const Scene& scene, const Camera& camera,
           const ImageOptions& options);

  /// Pixels that may see the polygon: no other can. Empty where it covers none.
  Bounds bounds_of(PolygonId polygon) const;

  /// No less than the nearness of any of its points.
  double nearness_of(PolygonId polygon) const;

  Prepared prepare(PolygonId polygon);

  /// Takes back what prepare() did last.
  void forget(const Prepared& polygon) { insides_.resize(polygon.first); }

  /// Whether the centre of pixel (i, j) is within the polygon.
  Verdict covers(const Prepared& polygon, std::int32_t i, std::int32_t j) const;

  /// What the polygon's nearness at the centre is between.
  static Bounded nearness_at(const Prepared& polygon, std::int32_t i,
                             std::int32_t j);

  /// Whether the polygon, a triangle, certainly has this Gouraud colour at the
  /// centre (S5.4).
  bool has_color(PolygonId polygon, const Prepared& prepared, std::int32_t i,
                 std::int32_t j, Rgb color) const;

 private:
  Projected project(const GridPoint& p) const;
  Plain plain(const Affine& f) const;
  /// Positive where the plane of this nearness is beyond the near distance.
  Affine beyond_near(const Affine& nearness, const Bounded& scale) const;

  const Scene& scene_;
  const Camera& camera_;
  bool cull_;
  LatticeVector origin_;
  Bounded rows_[3][3];  ///< X, Y and T from the point less the origin
  Bounded volume_;      ///< of sx, sy and the depth
  std::vector<Projected> vertices_;
  std::vector<Plain> insides_;
  /// Of the polygon that is being prepared.
  std::vector<Affine> lines_;
};

}  // namespace halfspace::shadow
