#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "halfspace/fast/types.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace::fast {

/// Half a unit in the last place of 1; or, to test the exact code behind the
/// filters, so much that they hardly ever decide.
#ifdef HALFSPACE_FILTERS_UNSURE
constexpr double kRounding = 1;
#else
constexpr double kRounding = 0x1p-53;
#endif

/// How far rounding can put a plane's value at an exact point of the scene off,
/// for a plane whose normal's components have sizes that add up to 1.
///
/// Let M, `most`, bound the sizes of coordinates, of the points that planes go
/// through and of those that they are asked about, N = |a| + |b| + |c|, u =
/// 2^-53. |d| = |n.p0| <= N M. Each coefficient is off by 2u at most, each
/// product adds u, and the three sums 3u, so the value is off by at most 6.01 u
/// (N M + |d|) <= 12.02 u N M. 16 leaves room for the roundings of the bound
/// itself, and for those of a new vertex (see meet()).
inline double rounding_of_values(double most) { return 16 * kRounding * most; }
inline double rounding_of_values(int grid_bits) {
  return rounding_of_values(std::ldexp(1.0, grid_bits - 1));
}

/// A value with a bound on how far it is off.
struct Bounded {
  double value = 0;
  double error = 0;
};

/// A plane prepared for value_at().
struct FilterPlane {
  Plane plane;
  double size = 0;  ///< |a| + |b| + |c|
};

inline FilterPlane filter_plane(const Plane& plane) {
  return {plane, std::abs(plane.a) + std::abs(plane.b) + std::abs(plane.c)};
}

/// The plane's value at the point that `v` stands for.
///
/// The true point is off `v` by v.error, which moves the value by at most
/// N v.error; the rest is rounding_of_values(), `rounding` here, for |x| up to
/// M + v.error: another 6.01 u N v.error. The bound computed here loses at most
/// 4u of itself. 2^-48 = 32u of v.error pays for both.
inline Bounded value_at(const FilterPlane& f, const Vertex& v,
                        double rounding) {
  const double value =
      f.plane.a * v.x + f.plane.b * v.y + f.plane.c * v.z + f.plane.d;
  return {value, f.size * (v.error * (1 + 0x1p-48) + rounding)};
}

/// The sign, or 0 where the error leaves it undecided: not the same as zero.
inline int filtered_sign([[maybe_unused]] const Bounded& b) {
#ifdef HALFSPACE_FILTERS_UNSURE
  return 0;
#else
  return (b.value > b.error) - (b.value < -b.error);
#endif
}

/// Where a plane meets the edge from `p` to `q`, on different sides of it, at
/// which it takes the values `hp` and `hq`.
///
/// Let t = hp / (hp - hq), exactly, and T the same of the computed values Hp
/// and Hq:
///   T - t = (hp (Hq - hq) - hq (Hp - hp)) / ((Hp - Hq)(hp - hq)).
/// The true signs differ, so
/// |hp - hq| = |hp| + |hq| and |T - t| <= max(errors) / |Hp - Hq|; also at most
/// 1, both being from 0 to 1. So the vertex is off by at most the larger error
/// of the ends, |T - t| of the edge, and the roundings: T is off by
/// another 2u, and with |q - p| <= 2M a coordinate by at most
/// 2u 2M + 2u 2M + u M = 9 u M < `rounding`. The factor 2 pays for the bound's
/// own roundings.
inline Vertex meet(const Vertex& p, const Bounded& hp, const Vertex& q,
                   const Bounded& hq, double rounding) {
  const double fall = hp.value - hq.value;
  const double t = fall == 0 ? 0.5 : std::clamp(hp.value / fall, 0.0, 1.0);
  const double doubt =
      fall == 0
          ? 1.0
          : std::min(1.0, 2 * std::max(hp.error, hq.error) / std::abs(fall));
  const double dx = q.x - p.x;
  const double dy = q.y - p.y;
  const double dz = q.z - p.z;
  const double length = std::max({std::abs(dx), std::abs(dy), std::abs(dz)});
  return {
      p.x + t * dx, p.y + t * dy, p.z + t * dz,
      (std::max(p.error, q.error) + doubt * length) * (1 + 0x1p-48) + rounding};
}

/// Where two planes meet the plane of three points, from the values `f` and `g`
/// that they take there; `extent` bounds the sizes of p1 - p0 and p2 - p0, and
/// of the meet less p0.
///
/// With w = f x g and W = w0 + w1 + w2 it is p0 + (w1 d1 + w2 d2) / W. Let F
/// and G bound the errors of f and g: each of w's two products is off by
/// |f| G + |g| F + F G, and rounding adds 3u of their sizes. With e0, e1, e2
/// those bounds and E their sum, a coordinate is off by at most
/// extent (e1 + e2 + E) / (|W| - E) <= extent 2E / (|W| - E). Rounding: the
/// quotients w / W by 4u, each product, sum and difference by u, in all less
/// than 12 u of extent (|w1| + |w2|) / |W| and u of the result: hence the 16u.
inline Vertex meet(const std::array<Vertex, 3>& p,
                   const std::array<Bounded, 3>& f,
                   const std::array<Bounded, 3>& g, double extent,
                   double rounding) {
  std::array<double, 3> w;
  double doubt = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const auto size = [](const Bounded& b) { return std::abs(b.value); };
    w[i] = f[j].value * g[k].value - f[k].value * g[j].value;
    doubt +=
        size(f[j]) * g[k].error + size(g[k]) * f[j].error +
        f[j].error * g[k].error + size(f[k]) * g[j].error +
        size(g[j]) * f[k].error + f[k].error * g[j].error +
        3 * kRounding * (size(f[j]) * size(g[k]) + size(f[k]) * size(g[j]));
  }
  doubt *= 1 + 0x1p-40;
  const double total = w[0] + w[1] + w[2];
  const double sure = std::abs(total) - 2 * doubt;
  if (!(sure > 0)) return {p[0].x, p[0].y, p[0].z, 2 * extent + rounding};
  const double s = w[1] / total;
  const double t = w[2] / total;
  const auto at = [s, t](double a, double b, double c) {
    return a + (s * (b - a) + t * (c - a));
  };
  const double error = extent * (2 * doubt / sure) +
                       16 * kRounding * extent * (std::abs(s) + std::abs(t));
  return {at(p[0].x, p[1].x, p[2].x), at(p[0].y, p[1].y, p[2].y),
          at(p[0].z, p[1].z, p[2].z), error * (1 + 0x1p-40) + rounding};
}

inline Vertex to_vertex(const GridPoint& p) {
  // At most 53 bits and a sign: exact.
  return {static_cast<double>(p.x), static_cast<double>(p.y),
          static_cast<double>(p.z), 0};
}

}  // namespace halfspace::fast
