#include "rounding/grid_predicates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/exact_plane.hpp"
#include "exact/filter.hpp"
#include "exact/wide.hpp"

namespace halfspace::fast {
namespace {

using Offset = Vector3<std::int64_t>;

/// Differences have 56 bits at most, so a component is below 2^113.
Vector3<Int128> cross_of(const Offset& u, const Offset& v) {
  return {Int128{u.y} * v.z - Int128{u.z} * v.y,
          Int128{u.z} * v.x - Int128{u.x} * v.z,
          Int128{u.x} * v.y - Int128{u.y} * v.x};
}

/// u x v . w, below 2^171.
int exact_sign(const Offset& u, const Offset& v, const Offset& w) {
  const Vector3<Int128> n = cross_of(u, v);
  return sign(multiply<3>(n.x, Int128{w.x}) + multiply<3>(n.y, Int128{w.y}) +
              multiply<3>(n.z, Int128{w.z}));
}

/// u x v in doubles, and for each component the sum of its products' sizes.
struct Cross {
  std::array<double, 3> value;
  std::array<double, 3> size;

  Cross(const Offset& u, const Offset& v) {
    const auto d = [](std::int64_t c) { return static_cast<double>(c); };
    const double yz = d(u.y) * d(v.z), zy = d(u.z) * d(v.y);
    const double zx = d(u.z) * d(v.x), xz = d(u.x) * d(v.z);
    const double xy = d(u.x) * d(v.y), yx = d(u.y) * d(v.x);
    value = {yz - zy, zx - xz, xy - yx};
    size = {std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz),
            std::abs(xy) + std::abs(yx)};
  }
};

/// The sign of u x v . w, or 0 where doubles cannot tell.
///
/// With e = 2^-53 each offset is off by e of itself, so each of the six
/// products of three factors by 3e, and by 2e more for its own roundings; the
/// sums add 4e of what is summed at most. So the value is off by less than 10 e
/// times the sum of the products' sizes, whose own sum loses less than 10 e.
int filtered_sign(const Cross& cross, const Offset& w) {
  const std::array<double, 3> at = {static_cast<double>(w.x),
                                    static_cast<double>(w.y),
                                    static_cast<double>(w.z)};
  const double value =
      cross.value[0] * at[0] + cross.value[1] * at[1] + cross.value[2] * at[2];
  const double size = cross.size[0] * std::abs(at[0]) +
                      cross.size[1] * std::abs(at[1]) +
                      cross.size[2] * std::abs(at[2]);
  return filtered_sign(Bounded{value, 12 * kRounding * size});
}

std::int64_t coordinate_of(const GridPoint& p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// An axis along which the triangle has an area.
int axis_of_area(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  int axis = 0;
  while (axis < 2 && turn_along(axis, a, b, c) == 0) ++axis;
  return axis;
}

/// Whether a point in a triangle's plane is in it, seen along an axis.
bool holds_point(int axis, const std::array<const GridPoint*, 3>& t,
                 const GridPoint& p) {
  bool left = false, right = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const int turn = turn_along(axis, *t[i], *t[(i + 1) % 3], p);
    left = left || turn > 0;
    right = right || turn < 0;
  }
  return !left || !right;
}

/// Whether two segments in a plane meet, seen along an axis.
bool segments_meet(int axis, const GridPoint& p, const GridPoint& q,
                   const GridPoint& a, const GridPoint& b) {
  const int pa = turn_along(axis, p, q, a), pb = turn_along(axis, p, q, b);
  const int ap = turn_along(axis, a, b, p), aq = turn_along(axis, a, b, q);
  if (pa * pb > 0 || ap * aq > 0) return false;
  if (pa != 0 || pb != 0 || ap != 0 || aq != 0) return true;
  // On one line: their extents must have a point in common.
  for (int other = 0; other < 3; ++other) {
    const std::int64_t first = coordinate_of(p, other);
    const std::int64_t last = coordinate_of(q, other);
    const std::int64_t from = coordinate_of(a, other);
    const std::int64_t to = coordinate_of(b, other);
    if (std::max(first, last) < std::min(from, to) ||
        std::max(from, to) < std::min(first, last))
      return false;
  }
  return true;
}

}  // namespace

bool on_one_line(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return turn_along(0, a, b, c) == 0 && turn_along(1, a, b, c) == 0 &&
         turn_along(2, a, b, c) == 0;
}

int side_of_triangle(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                     const GridPoint& d) {
  const Offset u = difference(a, b), v = difference(a, c), w = difference(a, d);
  const int known = filtered_sign(Cross(u, v), w);
  return known != 0 ? known : exact_sign(u, v, w);
}

bool on_one_side(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                 const std::array<const GridPoint*, 3>& points) {
  const Offset u = difference(a, b), v = difference(a, c);
  const Cross cross(u, v);
  int side = 0;
  for (const GridPoint* p : points) {
    const Offset w = difference(a, *p);
    const int known = filtered_sign(cross, w);
    const int s = known != 0 ? known : exact_sign(u, v, w);
    if (s == 0 || s * side < 0) return false;
    side = s;
  }
  return true;
}

/// A component is off by less than 4e of its products' sizes: by 3e for the
/// roundings of each product, and by e for that of the difference.
NormalSigns normal_signs(const GridPoint& a, const GridPoint& b,
                         const GridPoint& c) {
  const Cross cross(difference(a, b), difference(a, c));
  NormalSigns signs;
  for (std::size_t k = 0; k < 3; ++k) {
    const int s =
        filtered_sign(Bounded{cross.value[k], 6 * kRounding * cross.size[k]});
    if (s > 0)
      signs.positive = static_cast<std::uint8_t>(signs.positive | 1 << k);
    if (s < 0)
      signs.negative = static_cast<std::uint8_t>(signs.negative | 1 << k);
  }
  return signs;
}

int turn_along(int axis, const GridPoint& a, const GridPoint& b,
               const GridPoint& c) {
  const auto at = [axis](const GridPoint& p, int k) {
    return coordinate_of(p, (axis + k) % 3);
  };
  return sign(Int128{at(b, 1) - at(a, 1)} * (at(c, 2) - at(a, 2)) -
              Int128{at(b, 2) - at(a, 2)} * (at(c, 1) - at(a, 1)));
}

bool meets_triangle(const GridPoint& p, const GridPoint& q, const GridPoint& a,
                    const GridPoint& b, const GridPoint& c) {
  const int sp = side_of_triangle(a, b, c, p);
  const int sq = side_of_triangle(a, b, c, q);
  if (sp * sq > 0) return false;
  if (sp != 0 && sq != 0) {
    const int ab = side_of_triangle(p, q, a, b);
    const int bc = side_of_triangle(p, q, b, c);
    const int ca = side_of_triangle(p, q, c, a);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  }
  const int axis = axis_of_area(a, b, c);
  const std::array<const GridPoint*, 3> t = {&a, &b, &c};
  if (sp == 0 && holds_point(axis, t, p)) return true;
  if (sq == 0 && holds_point(axis, t, q)) return true;
  if (sp != 0 || sq != 0) return false;
  return segments_meet(axis, p, q, a, b) || segments_meet(axis, p, q, b, c) ||
         segments_meet(axis, p, q, c, a);
}

}  // namespace halfspace::fast
