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
  const double most = size * view.reach;
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

View make_view(const Camera& camera, int grid_bits, int samples) {
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

  const double grid = std::ldexp(1.0, grid_bits - 1);
  const auto error_of = [grid](const Affine3& f) {
    return 16 * kRounding * (growth_of(f) * grid + std::abs(f.d));
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

  const auto to_steps = [](const LatticeVector& v, int parts) {
    const double lattice = 1.0 / ((1 << kLatticeBits) * parts);
    return std::array<double, 3>{static_cast<double>(v.x) * lattice,
                                 static_cast<double>(v.y) * lattice,
                                 static_cast<double>(v.z) * lattice};
  };
  view.start = to_steps(data.s0, 1);
  view.right = to_steps(data.sx, samples);
  view.down = to_steps(data.sy, samples);
  view.reach = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    view.reach =
        std::max(view.reach,
                 std::abs(view.start[a]) +
                     (data.width_px * samples + 1) * std::abs(view.right[a]) +
                     (data.height_px * samples + 1) * std::abs(view.down[a]));
    view.start[a] += (view.right[a] + view.down[a]) / 2;
  }
  view.reach = (view.reach + grid) * (1 + 0x1p-40);

  const double step = data.perspective ? 1.0 / (1 << kLatticeBits) : 1.0;
  view.eye = {static_cast<double>(data.eye.x) * step,
              static_cast<double>(data.eye.y) * step,
              static_cast<double>(data.eye.z) * step};
  const double farthest = std::max(
      {std::abs(view.eye[0]), std::abs(view.eye[1]), std::abs(view.eye[2])});
  view.eye_error = 8 * kRounding * (farthest + (data.perspective ? grid : 0.0));
  return view;
}

}  // namespace halfspace::fast
