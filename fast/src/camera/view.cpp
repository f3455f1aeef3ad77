#include "camera/view.hpp"

#include <algorithm>
#include <limits>

#include "exact/exact_plane.hpp"

namespace halfspace::fast {
namespace {

/// The width of what follows: camera vectors have at most n + 15 bits after a
/// difference, so a cross product 2n + 31 and a determinant 3n + 47, which is
/// 209 at n = 54.
using CameraInt = Wide<4>;
using CameraVector = Vector3<CameraInt>;

LatticeVector minus(const LatticeVector& u, const LatticeVector& v) {
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}

CameraVector cross(const LatticeVector& u, const LatticeVector& v) {
  return {multiply<4>(u.y, v.z) - multiply<4>(u.z, v.y),
          multiply<4>(u.z, v.x) - multiply<4>(u.x, v.z),
          multiply<4>(u.x, v.y) - multiply<4>(u.y, v.x)};
}

CameraInt dot(const CameraVector& u, const LatticeVector& v) {
  return multiply<4>(u.x, v.x) + multiply<4>(u.y, v.y) + multiply<4>(u.z, v.z);
}

/// The coordinate row.(256 p - origin) / determinant of a grid point p.
Affine3 coordinate(const CameraVector& row, const LatticeVector& origin,
                   double determinant) {
  const double step = 1 << kLatticeBits;
  return {to_double(row.x) * step / determinant,
          to_double(row.y) * step / determinant,
          to_double(row.z) * step / determinant,
          -to_double(dot(row, origin)) / determinant};
}

/// `v` parts of a lattice step, in grid steps: a double and what is left of it.
/// Their sum is exact: a lattice vector has n + 14 bits, 8 of `parts` more, and
/// a double rounds at most 24 of them away.
struct TwoDoubles {
  std::array<double, 3> value;
  std::array<double, 3> rest;
};
[[gnu::noinline]] TwoDoubles in_steps(const LatticeVector& v, int parts) {
  const double step = 1.0 / ((1 << kLatticeBits) * parts);
  TwoDoubles sum;
  const Int128 of[3] = {v.x, v.y, v.z};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto value = static_cast<double>(of[a]);
    const auto rest = static_cast<double>(of[a] - static_cast<Int128>(value));
    sum.value[a] = value * step;
    sum.rest[a] = rest * step;
  }
  return sum;
}

LatticeVector times(const LatticeVector& v, int factor) {
  return {v.x * factor, v.y * factor, v.z * factor};
}

LatticeVector plus(const LatticeVector& u, const LatticeVector& v) {
  return {u.x + v.x, u.y + v.y, u.z + v.z};
}

double largest_of(const std::array<double, 3>& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

double growth_of(const Affine3& f) {
  return std::abs(f.a) + std::abs(f.b) + std::abs(f.c);
}

}  // namespace

ApproximateProjection project_approximately(const Plane& plane,
                                            const View& view) {
  const auto along = [&plane](const std::array<double, 3>& v) {
    return plane.a * v[0] + plane.b * v[1] + plane.c * v[2];
  };
  const double size = std::abs(plane.a) + std::abs(plane.b) + std::abs(plane.c);
  const double most = (size * view.reach + std::abs(plane.d)) * (1 + 0x1p-50);
  return {view.eye_value(plane),       along(view.right),     along(view.down),
          along(view.start) + plane.d, 16 * kRounding * most, most};
}

DepthDifference depth_difference(const ApproximateProjection& p,
                                 const ApproximateProjection& q) {
  const double e = p.eye.value;
  const double f = q.eye.value;
  const double e_most = std::abs(e) + p.eye.error;
  const double f_most = std::abs(f) + q.eye.error;
  const double error = e_most * q.error + (q.most + q.error) * p.eye.error +
                       f_most * p.error + (p.most + p.error) * q.eye.error +
                       12 * kRounding * (e_most * q.most + f_most * p.most);
  return {e * q.a - f * p.a, e * q.b - f * p.b, e * q.c - f * p.c,
          error * (1 + 0x1p-40)};
}

View make_view(const Camera& camera, const Extent& extent, int samples) {
  const CameraData& data = camera.data();
  const LatticeVector origin = data.perspective ? data.eye : data.s0;
  const LatticeVector depth =
      data.perspective ? minus(data.s0, data.eye) : minus({}, data.eye);
  const CameraVector across = cross(data.sx, data.sy);
  const CameraInt determinant = dot(across, depth);
  const double size = to_double(determinant);

  View view;
  view.perspective = data.perspective;
  view.orientation = sign(determinant);
  view.samples = samples;
  // The factor, a power of two, rounds nothing.
  const auto image = [&](const CameraVector& row) {
    const Affine3 f = coordinate(row, origin, size);
    const double k = samples;
    return Affine3{k * f.a, k * f.b, k * f.c, k * f.d};
  };
  view.x = image(cross(data.sy, depth));
  view.y = image(cross(depth, data.sx));
  view.t = coordinate(across, origin, size);

  const auto error_of = [&extent](const Affine3& f) {
    return 16 * kRounding * (growth_of(f) * extent.most + std::abs(f.d));
  };
  view.xy_error = std::max(error_of(view.x), error_of(view.y));
  view.t_error = error_of(view.t);
  view.xy_growth = std::max(growth_of(view.x), growth_of(view.y));
  view.t_growth = growth_of(view.t);

  if (data.perspective || data.near) {
    view.near =
        std::ldexp(static_cast<double>(data.near.value_or(0)), -kNearBits);
  } else {
    view.near = -std::numeric_limits<double>::infinity();
  }

  // The start in halves of samples.
  const LatticeVector half =
      plus(times(data.s0, 2 * samples), plus(data.sx, data.sy));
  const TwoDoubles start = in_steps(half, 2 * samples);
  view.start = start.value;
  view.start_rest = start.rest;
  view.right = in_steps(data.sx, samples).value;
  view.down = in_steps(data.sy, samples).value;
  view.reach = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double span =
        (data.width_px * samples + 1) * std::abs(view.right[a]) +
        (data.height_px * samples + 1) * std::abs(view.down[a]);
    view.span = std::max(view.span, span);
    view.reach = std::max(view.reach, std::abs(view.start[a]) + span);
  }
  view.reach *= 1 + 0x1p-40;
  view.span *= 1 + 0x1p-40;

  // A direction in place of the eye has no lattice.
  const TwoDoubles eye = data.perspective
                             ? in_steps(data.eye, 1)
                             : in_steps(times(data.eye, 1 << kLatticeBits), 1);
  view.eye = eye.value;
  view.eye_rest = eye.rest;
  const double farthest = largest_of(view.eye);
  const double grid = data.perspective ? extent.grid : 0.0;
  view.eye_error = 8 * kRounding * (farthest + grid);
  if (data.perspective) {
    view.sight =
        in_steps(plus(half, times(data.eye, -2 * samples)), 2 * samples).value;
  }
  // The rest, at most u of the whole, is off by u of that again.
  view.slack = kRounding * (farthest + largest_of(view.start));
  return view;
}

}  // namespace halfspace::fast
