#include "raster/depth_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace halfspace::fast {

namespace {

using Point = std::array<double, 3>;

/// Three corners of a fragment in camera coordinates, with their errors; and
/// the least t of all of them, and its greatest size.
struct CameraCorners {
  std::array<Point, 3> corners{};
  double xy_error = 0;
  double t_error = 0;
  double nearest = std::numeric_limits<double>::infinity();
  double most = 0;
};

CameraCorners camera_corners(std::span<const Vertex> corners,
                             const View& view) {
  CameraCorners result;
  double error = 0;
  std::size_t k = 0;
  for (const Vertex& p : corners) {
    const double t = view.t.at(p.x, p.y, p.z);
    result.nearest = std::min(result.nearest, t);
    result.most = std::max(result.most, std::abs(t));
    error = std::max(error, p.error);
    if (k < 3) {
      result.corners[k] = {view.x.at(p.x, p.y, p.z), view.y.at(p.x, p.y, p.z),
                           t};
    }
    ++k;
  }
  constexpr double kMargin = 1 + 0x1p-40;
  result.xy_error = (view.xy_error + view.xy_growth * error) * kMargin;
  result.t_error = (view.t_error + view.t_growth * error) * kMargin;
  return result;
}

}  // namespace

/// With V the corners in camera coordinates and N = (V1 - V0) x (V2 - V0), a
/// point (x t, y t, t) of the plane has N.(x, y, 1) t = N.V0: so in perspective
/// 1 / t is N.(x, y, 1) / N.V0. Else -t is (Nx x + Ny y - N.V0) / Nz.
///
/// Let e bound the errors of X and Y, f those of t, D and d the sizes of the
/// differences; these are off by a = 2e + u D and b = 2f + u d. So Nx and Ny
/// are off by n = 2 (a d + b D + a b) + 6u D d, Nz by m = 2 (2 a D + a a) +
/// 6u D D, and N.V0, with W the size of N V0's products, by
/// n (|X| + |Y| + 2 e) + m (|t| + f) + e (|Nx| + |Ny|) + f |Nz| + 5u W. The
/// quotient p / q of a dividend off by g and a divisor off by h is off by
/// (g + |r| h) / |q| for the true quotient r, which is within those of the
/// corners at the pixels that the fragment covers. The roundings of the
/// quotients and of a i + b j + c take 8u of their sizes, and as much a
/// difference of two: 16u. 2^-20 of all is room for the bound's own roundings.
DepthDifference depth_of(std::span<const Vertex> corners, const View& view,
                         std::int32_t farthest) {
  const CameraCorners seen = camera_corners(corners, view);
  const double e = seen.xy_error;
  const double f = seen.t_error;
  if (view.perspective && !(seen.nearest > f)) return {0, 0, 0, 1e300};
  const Point& v = seen.corners[0];
  const auto to = [&](std::size_t c) {
    return Point{seen.corners[c][0] - v[0], seen.corners[c][1] - v[1],
                 seen.corners[c][2] - v[2]};
  };
  const Point p = to(1);
  const Point q = to(2);
  const auto size = [](double a, double b) {
    return std::max(std::abs(a), std::abs(b));
  };
  const double wide = std::max(size(p[0], p[1]), size(q[0], q[1]));
  const double deep = size(p[2], q[2]);
  const double a = 2 * e + kRounding * wide;
  const double b = 2 * f + kRounding * deep;
  const double n_error =
      2 * (a * deep + b * wide + a * b) + 6 * kRounding * wide * deep;
  const double m_error =
      2 * (2 * a * wide + a * a) + 6 * kRounding * wide * wide;
  const Point n = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                   p[0] * q[1] - p[1] * q[0]};
  const Point parts = {n[0] * v[0], n[1] * v[1], n[2] * v[2]};
  const double at_corner = parts[0] + parts[1] + parts[2];
  const double corner_error =
      n_error * (std::abs(v[0]) + std::abs(v[1]) + 2 * e) +
      m_error * (std::abs(v[2]) + f) + e * (std::abs(n[0]) + std::abs(n[1])) +
      f * std::abs(n[2]) +
      5 * kRounding *
          (std::abs(parts[0]) + std::abs(parts[1]) + std::abs(parts[2]));
  const double reach = static_cast<double>(farthest) + 1;
  const double divisor = view.perspective ? at_corner : n[2];
  const double rest = view.perspective ? n[2] : -at_corner;
  const double g =
      2 * n_error * reach + (view.perspective ? m_error : corner_error);
  const double h = view.perspective ? corner_error : m_error;
  const double r = view.perspective ? 1 / (seen.nearest - f) : seen.most + f;
  DepthDifference depth;
  depth.a = n[0] / divisor;
  depth.b = n[1] / divisor;
  depth.c = (rest + (n[0] + n[1]) / 2) / divisor;
  const double sizes =
      (std::abs(depth.a) + std::abs(depth.b)) * reach + std::abs(depth.c);
  depth.error = ((g + r * h) / std::abs(divisor) + 16 * kRounding * sizes) *
                (1 + 0x1p-20);
  return depth;
}

}  // namespace halfspace::fast
