#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "exact/wide.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// The integers that hold what is computed from a scene with coordinates of
/// `kBits` bits, so of size at most 2^(n-1).
///
/// Bits, as exponents e of a bound 2^e on the size:
///   difference of two points      n
///   component of a normal         2n + 1
///   value of a plane at a point   (2n + 1) + n + 2        = 3n + 3
///   2x2 determinant of values     2 (3n + 3) + 1          = 6n + 7
///   3x3 determinant of values     3 (3n + 3) + 3          = 9n + 12
/// so values take 81, 123 and 165, and determinants of three 246, 372 and 498:
/// 4, 6 and 8 words hold them with their sign.
template <int kBits>
struct Grid {
  static_assert(kBits == 26 || kBits == 40 || kBits == 54);
  static constexpr std::size_t kWords = kBits == 26 ? 4 : kBits == 40 ? 6 : 8;
  using Determinant = Wide<kWords>;
  using Normal = std::conditional_t<kBits == 26, std::int64_t, Int128>;
  using Value = std::conditional_t<kBits == 54, Wide<3>, Int128>;
};

/// A vector whose components are exact.
template <class Int>
struct Vector3 {
  Int x{};
  Int y{};
  Int z{};
  friend bool operator==(const Vector3&, const Vector3&) = default;
};

/// q - p. Size: each component at most 2^n, so it fits 64 bits.
inline Vector3<std::int64_t> difference(const GridPoint& p,
                                        const GridPoint& q) {
  return {q.x - p.x, q.y - p.y, q.z - p.z};
}

template <int kBits>
Vector3<typename Grid<kBits>::Normal> cross(const Vector3<std::int64_t>& u,
                                            const Vector3<std::int64_t>& v) {
  using N = typename Grid<kBits>::Normal;
  if constexpr (kSlowProducts && sizeof(N) == sizeof(Int128)) {
    constexpr std::int64_t kMost = std::int64_t{1} << 31;
    const auto fits = [](const Vector3<std::int64_t>& d) {
      return d.x < kMost && d.x > -kMost && d.y < kMost && d.y > -kMost &&
             d.z < kMost && d.z > -kMost;
    };
    if (fits(u) && fits(v)) {
      return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z,
              u.x * v.y - u.y * v.x};
    }
  }
  return {N{u.y} * v.z - N{u.z} * v.y, N{u.z} * v.x - N{u.x} * v.z,
          N{u.x} * v.y - N{u.y} * v.x};
}

/// A plane, exactly: its normal and a point on it, or a coordinate's.
template <int kBits>
struct ExactPlane {
  Vector3<typename Grid<kBits>::Normal> normal;
  GridPoint origin;
};

/// h(p) (S1.5).
template <int kBits>
typename Grid<kBits>::Value value_at(const ExactPlane<kBits>& plane,
                                     const GridPoint& p) {
  const Vector3<std::int64_t> v = difference(plane.origin, p);
  if constexpr (kBits == 54) {
    if (kSlowProducts && is_short(plane.normal.x) && is_short(plane.normal.y) &&
        is_short(plane.normal.z)) {
      const auto times = [](Int128 n, std::int64_t d) {
        return product_of(static_cast<std::int64_t>(n), d);
      };
      return times(plane.normal.x, v.x) + times(plane.normal.y, v.y) +
             times(plane.normal.z, v.z);
    }
    return multiply<3>(plane.normal.x, Int128{v.x}) +
           multiply<3>(plane.normal.y, Int128{v.y}) +
           multiply<3>(plane.normal.z, Int128{v.z});
  } else {
    return Int128{plane.normal.x} * v.x + Int128{plane.normal.y} * v.y +
           Int128{plane.normal.z} * v.z;
  }
}

/// The plane of the polygon with these defining corners (S1.4).
template <int kBits>
ExactPlane<kBits> exact_plane(const std::array<GridPoint, 3>& corners) {
  return {cross<kBits>(difference(corners[0], corners[1]),
                       difference(corners[0], corners[2])),
          corners[0]};
}

/// The free plane on which coordinate `axis` is `coordinate`.
template <int kBits>
ExactPlane<kBits> axis_plane(int axis, std::int64_t coordinate) {
  ExactPlane<kBits> plane;
  if (axis == 0) {
    plane.normal.x = 1;
    plane.origin.x = coordinate;
  } else if (axis == 1) {
    plane.normal.y = 1;
    plane.origin.y = coordinate;
  } else {
    plane.normal.z = 1;
    plane.origin.z = coordinate;
  }
  return plane;
}

/// The values of a plane at the three corners that define a fragment's plane,
/// or at the two ends of an edge.
template <int kBits, std::size_t kCount>
std::array<typename Grid<kBits>::Value, kCount> values_at(
    const ExactPlane<kBits>& plane,
    const std::array<GridPoint, kCount>& points) {
  std::array<typename Grid<kBits>::Value, kCount> values;
  for (std::size_t i = 0; i < kCount; ++i) {
    values[i] = value_at(plane, points[i]);
  }
  return values;
}

/// f[i] g[j] - f[j] g[i].
template <int kBits, class Values>
typename Grid<kBits>::Determinant minor(const Values& f, const Values& g,
                                        std::size_t i, std::size_t j) {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  return multiply<kWords>(f[i], g[j]) - multiply<kWords>(f[j], g[i]);
}

/// The sign of plane `r` where plane `q` meets the line through two points of
/// which it separates or touches at most one.
///
/// The meet is (q0 p1 - q1 p0) / (q0 - q1), where r takes the value
/// (q0 r1 - q1 r0) / (q0 - q1).
/// Requires: q0 != q1.
template <int kBits>
int sign_at_meet(const ExactPlane<kBits>& q,
                 const std::array<GridPoint, 2>& line,
                 const ExactPlane<kBits>& r) {
  const auto q_values = values_at<kBits>(q, line);
  const auto r_values = values_at<kBits>(r, line);
  return sign(minor<kBits>(q_values, r_values, 0, 1)) *
         sign(q_values[0] - q_values[1]);
}

/// The sign of plane `r` where planes `q` and `s` and the plane of three points
/// meet.
///
/// In coordinates with weights w0 + w1 + w2 = 1 over the three points, q and s
/// vanish where w is parallel to the cross product of their values, and r
/// takes the value w.r there.
/// Requires: they meet in one point.
template <int kBits>
int sign_at_meet(const ExactPlane<kBits>& q, const ExactPlane<kBits>& s,
                 const std::array<GridPoint, 3>& corners,
                 const ExactPlane<kBits>& r) {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  const auto q_values = values_at<kBits>(q, corners);
  const auto s_values = values_at<kBits>(s, corners);
  const auto r_values = values_at<kBits>(r, corners);
  const auto w0 = minor<kBits>(q_values, s_values, 1, 2);
  const auto w1 = minor<kBits>(q_values, s_values, 2, 0);
  const auto w2 = minor<kBits>(q_values, s_values, 0, 1);
  const auto value = multiply<kWords>(w0, r_values[0]) +
                     multiply<kWords>(w1, r_values[1]) +
                     multiply<kWords>(w2, r_values[2]);
  return sign(value) * sign(w0 + w1 + w2);
}

/// Calls `run` with the grid's bits as a compile-time constant; where code is
/// to be small, with those of the widest grid, whose integers hold all.
template <class Run>
decltype(auto) with_grid([[maybe_unused]] int grid_bits, Run&& run) {
#if !defined(HALFSPACE_WIDEST_GRID_ALONE)
  if (grid_bits == 26) return run(std::integral_constant<int, 26>{});
  if (grid_bits == 40) return run(std::integral_constant<int, 40>{});
#endif
  return run(std::integral_constant<int, 54>{});
}

}  // namespace halfspace::fast
