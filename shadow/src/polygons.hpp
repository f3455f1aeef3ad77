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

/// A point of space in camera coordinates: eye + X sx + Y sy + T (s0 - eye) in
/// perspective, else s0 + X sx + Y sy - T eye. W is T, or 1. Its image point is
/// (X/W, Y/W).
struct Projected {
  Bounded x, y, w, t;
  double column = 0;  ///< X/W, to less than a pixel, if that is known
  double row = 0;     ///< Y/W, the same
  /// At least 1/T in perspective, else at least -T.
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

/// The same, with one error bound for all pixel centres.
struct Plain {
  double c = 0, dx = 0, dy = 0;
  double error = HUGE_VAL;

  double value_at(double x, double y) const { return c + x * dx + y * dy; }
  Bounded at(double x, double y) const { return {value_at(x, y), error}; }
};

/// The answer of a filter.
enum class Verdict : std::uint8_t { kNo, kYes, kUnknown };

/// A polygon's edge functions and depth (PIN88).
struct Prepared {
  /// A sample is covered where all edge functions are positive, the near
  /// plane's included (S4.5): Polygons::insides_[first, first + count).
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Plain nearness;        ///< 1/T in perspective, else -T
  bool certain = false;  ///< false: nothing is known of the polygon
};

/// The polygons of a scene seen by a camera, in doubles with error bounds.
class Polygons {
 public:
  Polygons(const Scene& scene, const Camera& camera,
           const ImageOptions& options);

  /// Holds every pixel that the polygon covers; empty if it covers none.
  Bounds bounds_of(PolygonId polygon) const;

  /// At least the nearness of each of its points.
  double nearness_of(PolygonId polygon) const;

  Prepared prepare(PolygonId polygon);

  /// Frees the polygon's edge functions. Requires: it was prepared last.
  void forget(const Prepared& polygon) { insides_.resize(polygon.first); }

  /// Whether the polygon covers the centre of pixel (i, j).
  Verdict covers(const Prepared& polygon, std::int32_t i, std::int32_t j) const;

  /// The polygon's nearness at the centre.
  static Bounded nearness_at(const Prepared& polygon, std::int32_t i,
                             std::int32_t j);

  /// Whether the triangle certainly has this Gouraud colour at the centre
  /// (S5.4; GOU71).
  bool has_color(PolygonId polygon, const Prepared& prepared, std::int32_t i,
                 std::int32_t j, Rgb color) const;

 private:
  Projected project(const GridPoint& p) const;
  Plain plain(const Affine& f) const;
  /// A clip plane's values (S10.1): at the eye, or along it, and at the image.
  struct Clip {
    Bounded at_eye;
    Affine at_image;
  };
  /// Positive where the polygon is on the plane's positive side.
  Affine kept_by(const Clip& clip, const Affine& nearness,
                 const Bounded& scale) const;
  /// Positive where a plane of this nearness lies beyond the near distance.
  Affine beyond_near(const Affine& nearness, const Bounded& scale) const;

  const Scene& scene_;
  const Camera& camera_;
  bool cull_;
  LatticeVector origin_;
  Bounded rows_[3][3];  ///< X, Y and T from the point less the origin
  Bounded volume_;      ///< of sx, sy and the depth
  std::vector<Clip> clips_;
  std::vector<Projected> vertices_;
  std::vector<Plain> insides_;
  /// Edge functions of the polygon that is being prepared.
  std::vector<Affine> lines_;
};

}  // namespace halfspace::shadow
