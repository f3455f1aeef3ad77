#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "exact/filter.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/fast/types.hpp"

namespace halfspace::fast {

/// An affine function of a point of space, in doubles.
struct Affine3 {
  double a = 0;
  double b = 0;
  double c = 0;
  double d = 0;
  double at(double x, double y, double z) const {
    return a * x + b * y + c * z + d;
  }
};

/// A camera, prepared in doubles for one scene.
///
/// A point p has camera coordinates X, Y and t (S4.1):
///   in perspective    p = e + X sx + Y sy + t (s0 - e),
///   else              p = s0 + X sx + Y sy - t eye.
/// It is shown at (X/t, Y/t), or (X, Y).
struct View {
  Affine3 x, y, t;
  bool perspective = true;
  /// The sign of det[sx, sy, depth], depth being what t multiplies. A polygon
  /// with the eye on side `s` of its plane is seen turning by
  /// -orientation * s, where x to y is the positive turn: the image of a
  /// triangle has the determinant det(M) det[p0 - e, p1 - e, p2 - e] over
  /// positive t's, M having the sign of the camera's determinant, and the
  /// second factor is -h(e).
  int orientation = 1;
  /// Points with t at or below this are not seen; -infinity if no limit.
  double near = 0;
  /// x and y count samples, so many a pixel each way (S5.7): a power of two.
  int samples = 1;

  /// How far rounding can put X and Y, and t, off for an exact point of the
  /// scene: the coefficients are off by 2^-51 each, two conversions and a
  /// quotient of at most 2u + 2u + u; a product and three sums add 4u; so 8u
  /// of the sum of sizes, 16 with a margin for the bound's own roundings.
  double xy_error = 0;
  double t_error = 0;
  /// By how much a point's error can grow: the sums of the coefficients' sizes.
  double xy_growth = 0;
  double t_growth = 0;

  /// The eye in grid steps, or the direction towards the viewer.
  std::array<double, 3> eye{};
  /// How far rounding can put the value of a plane at the eye off, for a normal
  /// whose components' sizes add up to 1. With E the largest of the eye's
  /// coordinates and M = 2^(n-1): coefficient 2u, eye u, product u, sums 3u, of
  /// N E + |d| <= N (E + M); 8u of that with a margin.
  double eye_error = 0;

  /// The centre of pixel (i, j) is start + i right + j down. Units: grid steps.
  std::array<double, 3> start{};
  std::array<double, 3> right{};
  std::array<double, 3> down{};
  /// Bounds the sizes of the image points' coordinates.
  double reach = 0;

  /// The eye and the start less what they are above: with it they are exact.
  /// The start less the eye, which is rounded once, bounded by `slack` and 5u
  /// of itself. How far image points are from the start at most.
  std::array<double, 3> eye_rest{};
  std::array<double, 3> start_rest{};
  std::array<double, 3> sight{};
  double span = 0;
  /// A difference to the eye or the start in doubles, less the rest, is off by
  /// 5u of the sum of this and its size.
  double slack = 0;

  /// Units: grid steps for points, pixels for images.
  Bounded eye_value(const Plane& p) const {
    const double value =
        p.a * eye[0] + p.b * eye[1] + p.c * eye[2] + (perspective ? p.d : 0.0);
    return {value, (std::abs(p.a) + std::abs(p.b) + std::abs(p.c)) * eye_error};
  }
};

/// A projected plane in doubles: its value at the centre of pixel (i, j) is
/// a i + b j + c. With N the sum of the normal's sizes, R the view's reach and
/// Q = N R + |d|: a coefficient is off by 2u, a camera vector by 2u, a product
/// by u, sums by 4u, so each of a i, b j and c by 9u of its share of Q, and
/// their sum by 3u more: `error`, 16u Q, bounds all that and stays a bound for
/// the sum of any two of them. |a i + b j + c| <= Q.
struct ApproximateProjection {
  Bounded eye;
  double a = 0;
  double b = 0;
  double c = 0;
  double error = 0;
  double most = 0;  ///< Q
};

ApproximateProjection project_approximately(const Plane& plane,
                                            const View& view);

/// The difference of two planes' depths, P(e) Q(s) - Q(e) P(s): positive where
/// plane `p` is nearer if the eye is on the positive side of both. At the
/// centre of pixel (i, j) it is a i + b j + c, off by at most `error`.
struct DepthDifference {
  double a = 0;
  double b = 0;
  double c = 0;
  double error = 0;

  /// Its sign at the centre of pixel (i, j), or 0 if `error` exceeds it.
  int filtered_sign_at(std::int32_t i, std::int32_t j) const {
    const double value = a * i + (b * j + c);
    return (value > error) - (value < -error);
  }
};

/// With E, F the true values at the eye, |E| <= |e| + e', and q, p the values
/// at s: |E q - e q~| <= |E| q' + |q| e' for each of both products; q~ is at
/// most most + error. Rounding adds 2u in each coefficient's products and sum,
/// and 5u in those of a i + b j + c: 8u of (|e| + |f|) most, with a margin.
DepthDifference depth_difference(const ApproximateProjection& p,
                                 const ApproximateProjection& q);

/// The difference of two depths (see depth_of()): positive where the first is
/// nearer.
inline DepthDifference difference_of_depths(const DepthDifference& p,
                                            const DepthDifference& q) {
  return {p.a - q.a, p.b - q.b, p.c - q.c, (p.error + q.error) * (1 + 0x1p-40)};
}

/// Bounds the sizes of coordinates: of the points that are seen, and of points
/// of all planes. Units: grid steps.
struct Extent {
  double most = 0;
  double grid = 0;
};
inline Extent extent_of_grid(int grid_bits) {
  const double grid = std::ldexp(1.0, grid_bits - 1);
  return {grid, grid};
}

/// The view, of points within the extent, in which x and y, and the pixels
/// named here, are samples, so many a pixel each way.
View make_view(const Camera& camera, const Extent& extent, int samples = 1);
inline View make_view(const Camera& camera, int grid_bits, int samples = 1) {
  return make_view(camera, extent_of_grid(grid_bits), samples);
}

}  // namespace halfspace::fast
