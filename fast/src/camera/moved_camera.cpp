#include "camera/moved_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace halfspace::fast {
namespace {

using MovedInt = MovedCamera::Int;
using MovedVector = Vector3<MovedInt>;
/// Holds every product here: see edge_function().
using MovedWide = Wide<14>;
using MovedWideVector = Vector3<MovedWide>;

/// Minors of M, transposed. Bits: 125 of 127.
std::array<Int128, 9> adjugate(const std::array<std::int64_t, 9>& m) {
  const auto minor = [&m](std::size_t a, std::size_t b, std::size_t c,
                          std::size_t d) {
    return Int128{m[a]} * m[d] - Int128{m[b]} * m[c];
  };
  return {minor(4, 5, 7, 8), minor(2, 1, 8, 7), minor(1, 2, 4, 5),
          minor(5, 3, 8, 6), minor(0, 2, 6, 8), minor(2, 0, 5, 3),
          minor(3, 4, 6, 7), minor(1, 0, 7, 6), minor(0, 1, 3, 4)};
}

MovedVector operator-(const MovedVector& v) { return {-v.x, -v.y, -v.z}; }
MovedVector difference(const MovedVector& u, const MovedVector& v) {
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}

/// The point w p. Bits: 197 and 54.
MovedVector scaled(const GridPoint& p, const MovedInt& w) {
  return {multiply<5>(w, Int128{p.x}), multiply<5>(w, Int128{p.y}),
          multiply<5>(w, Int128{p.z})};
}

MovedWideVector cross_of(const MovedVector& u, const MovedVector& v) {
  return {multiply<14>(u.y, v.z) - multiply<14>(u.z, v.y),
          multiply<14>(u.z, v.x) - multiply<14>(u.x, v.z),
          multiply<14>(u.x, v.y) - multiply<14>(u.y, v.x)};
}

MovedWide dot_of(const MovedWideVector& u, const MovedVector& v) {
  return multiply<14>(u.x, v.x) + multiply<14>(u.y, v.y) +
         multiply<14>(u.z, v.z);
}

/// The coordinate row.(w p - origin) / determinant of a grid point p: products
/// are exact, so a coefficient is two conversions and a quotient, as it is in a
/// camera that is not moved.
Affine3 coordinate_of(const MovedWideVector& row, const MovedVector& origin,
                      const MovedInt& w, double determinant) {
  const auto times_w = [&w](const MovedWide& value) {
    return to_double(multiply<14>(value, w));
  };
  return {times_w(row.x) / determinant, times_w(row.y) / determinant,
          times_w(row.z) / determinant,
          -to_double(dot_of(row, origin)) / determinant};
}

double growth(const Affine3& f) {
  return std::abs(f.a) + std::abs(f.b) + std::abs(f.c);
}

/// v / w / parts. Off by 5u of itself: two conversions and a quotient; the
/// division by a power of two rounds nothing.
std::array<double, 3> steps_of(const MovedVector& v, const MovedInt& w,
                               int parts) {
  const double divisor = to_double(w);
  return {to_double(v.x) / divisor / parts, to_double(v.y) / divisor / parts,
          to_double(v.z) / divisor / parts};
}

double greatest(const std::array<double, 3>& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

}  // namespace

MovedCamera moved_camera(const CameraData& camera, const ObjectMap& to_world) {
  const std::array<Int128, 9> inverse = adjugate(to_world.m);
  const Int128 scale = Int128{1} << to_world.shift;
  const auto vector = [&](const Wide<3>& x, const Wide<3>& y,
                          const Wide<3>& z) {
    const auto row = [&](std::size_t k) {
      return multiply<5>(inverse[3 * k], x) +
             multiply<5>(inverse[3 * k + 1], y) +
             multiply<5>(inverse[3 * k + 2], z);
    };
    return MovedVector{row(0), row(1), row(2)};
  };
  const auto direction = [&](const LatticeVector& v) {
    return vector(multiply<3>(v.x, scale), multiply<3>(v.y, scale),
                  multiply<3>(v.z, scale));
  };
  const auto point = [&](const LatticeVector& v) {
    const Int128 step = Int128{1} << kLatticeBits;
    return vector(multiply<3>(v.x, scale) - multiply<3>(to_world.t[0], step),
                  multiply<3>(v.y, scale) - multiply<3>(to_world.t[1], step),
                  multiply<3>(v.z, scale) - multiply<3>(to_world.t[2], step));
  };
  MovedCamera moved;
  moved.perspective = camera.perspective;
  moved.near = camera.near;
  moved.width_px = camera.width_px;
  moved.height_px = camera.height_px;
  moved.in_world = camera;
  moved.to_world = to_world;
  moved.eye = camera.perspective ? point(camera.eye) : direction(camera.eye);
  moved.s0 = point(camera.s0);
  moved.sx = direction(camera.sx);
  moved.sy = direction(camera.sy);
  const MovedInt determinant = multiply<5>(Int128{to_world.m[0]}, inverse[0]) +
                               multiply<5>(Int128{to_world.m[1]}, inverse[3]) +
                               multiply<5>(Int128{to_world.m[2]}, inverse[6]);
  moved.w = multiply<5>(determinant, Int128{1} << kLatticeBits);
  if (moved.w.is_negative()) {
    moved.eye = -moved.eye;
    moved.s0 = -moved.s0;
    moved.sx = -moved.sx;
    moved.sy = -moved.sy;
    moved.w = -moved.w;
  }
  return moved;
}

ProjectedPlane<kMovedGrid> projected(const ExactPlane<kMovedGrid>& plane,
                                     const MovedCamera& camera, int samples) {
  const auto along = [&](const MovedVector& v) {
    return multiply<6>(Int128{plane.normal.x}, v.x) +
           multiply<6>(Int128{plane.normal.y}, v.y) +
           multiply<6>(Int128{plane.normal.z}, v.z);
  };
  const MovedVector origin = scaled(plane.origin, camera.w);
  const auto above = [&](const MovedVector& v) {
    return along(difference(v, origin));
  };
  return {camera.perspective ? above(camera.eye) : along(camera.eye),
          along(camera.sx), along(camera.sy),
          multiply<6>(above(camera.s0), Int128{2 * samples})};
}

EdgeFunction<14> edge_function(const GridPoint& p, const GridPoint& q,
                               const MovedCamera& camera, int samples) {
  const MovedVector from = scaled(p, camera.w);
  const MovedVector to = scaled(q, camera.w);
  const MovedVector u =
      camera.perspective ? difference(to, camera.eye) : camera.eye;
  const MovedVector v =
      camera.perspective ? difference(from, camera.eye) : difference(to, from);
  const MovedVector& origin = camera.perspective ? camera.eye : from;
  const MovedWideVector normal = cross_of(u, v);
  return {dot_of(normal, camera.sx), dot_of(normal, camera.sy),
          multiply<14>(dot_of(normal, difference(camera.s0, origin)),
                       Int128{2 * samples})};
}

EdgeFunction<14> near_function(const ProjectedPlane<kMovedGrid>& p,
                               std::int64_t near, bool perspective,
                               int samples) {
  const Int128 unit = Int128{1} << kNearBits;
  const auto times = [](const Wide<6>& value, Int128 factor) {
    return multiply<14>(value, factor);
  };
  if (perspective) {
    return {times(p.a, near), times(p.b, near),
            times(p.c, near) + times(p.eye, 2 * samples * (unit - near))};
  }
  return {times(p.a, unit), times(p.b, unit),
          times(p.c, unit) - times(p.eye, Int128{2 * samples} * near)};
}

EdgeFunction<14> meet_function(const ProjectedPlane<kMovedGrid>& p,
                               const ProjectedPlane<54>& q) {
  const auto part = [&](const Wide<6>& p_part, const Wide<3>& q_part) {
    return multiply<14>(p.eye, q_part) - multiply<14>(q.eye, p_part);
  };
  return {part(p.a, q.a), part(p.b, q.b), part(p.c, q.c)};
}

View make_view(const MovedCamera& camera, int grid_bits, int samples) {
  const MovedVector origin = camera.perspective ? camera.eye : camera.s0;
  const MovedVector depth =
      camera.perspective ? difference(camera.s0, camera.eye) : -camera.eye;
  const MovedWideVector across = cross_of(camera.sx, camera.sy);
  const MovedWide determinant = dot_of(across, depth);
  const double size = to_double(determinant);
  View view;
  view.perspective = camera.perspective;
  view.orientation = sign(determinant);
  view.samples = samples;
  const auto image = [&](const MovedWideVector& row) {
    const Affine3 f = coordinate_of(row, origin, camera.w, size);
    const double k = samples;
    return Affine3{k * f.a, k * f.b, k * f.c, k * f.d};
  };
  view.x = image(cross_of(camera.sy, depth));
  view.y = image(cross_of(depth, camera.sx));
  view.t = coordinate_of(across, origin, camera.w, size);
  const double grid = std::ldexp(1.0, grid_bits - 1);
  const auto error_of = [grid](const Affine3& f) {
    return 16 * kRounding * (growth(f) * grid + std::abs(f.d));
  };
  view.xy_error = std::max(error_of(view.x), error_of(view.y));
  view.t_error = error_of(view.t);
  view.xy_growth = std::max(growth(view.x), growth(view.y));
  view.t_growth = growth(view.t);
  if (camera.perspective || camera.near) {
    view.near =
        std::ldexp(static_cast<double>(camera.near.value_or(0)), -kNearBits);
  } else {
    view.near = -std::numeric_limits<double>::infinity();
  }
  view.start = steps_of(camera.s0, camera.w, 1);
  view.right = steps_of(camera.sx, camera.w, samples);
  view.down = steps_of(camera.sy, camera.w, samples);
  view.eye = steps_of(camera.eye, camera.w, 1);
  view.reach = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double span =
        (camera.width_px * samples + 1) * std::abs(view.right[a]) +
        (camera.height_px * samples + 1) * std::abs(view.down[a]);
    view.span = std::max(view.span, span);
    view.reach = std::max(view.reach, std::abs(view.start[a]) + span);
    view.start[a] += (view.right[a] + view.down[a]) / 2;
    view.sight[a] = view.start[a] - view.eye[a];
  }
  // Vectors of a camera are off by 5u here and not 2u. Bounds that are products
  // of a reach, or two, pay for that by a reach that is twice as large, that of
  // the eye included.
  const double farthest = greatest(view.eye);
  view.reach = 2 * (view.reach + grid + farthest) * (1 + 0x1p-40);
  view.span *= 1 + 0x1p-40;
  // The eye and the start are off by 7u of themselves at most.
  view.slack = 2 * (farthest + greatest(view.start));
  // Coefficient 2u, eye 5u, product u, sums 3u: 11u of N E + |d|.
  view.eye_error =
      16 * kRounding * (farthest + (camera.perspective ? grid : 0.0));
  return view;
}

}  // namespace halfspace::fast
