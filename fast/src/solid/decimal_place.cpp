#include "solid/decimal_place.hpp"

#include <cstddef>

#include "exact/nearest_double.hpp"

namespace halfspace::fast {
namespace {

/// Holds the coordinates of a meet: 9n + 12 bits; and what they are divided by,
/// 6n + 6 bits, times 10^22, which has 74.
using Number = Wide<8>;
using Normal = std::array<Int128, 3>;

/// A plane: its normal, and the product of that with each of its points.
struct OffsetPlane {
  Normal normal;
  Wide<3> offset;
};

OffsetPlane offset_plane(const GeometryTable& table, std::int32_t plane) {
  const Vector3<Int128> n = table.normal(plane);
  const GridPoint& at = table.plane(plane).origin;
  return {{n.x, n.y, n.z},
          multiply<3>(n.x, Int128{at.x}) + multiply<3>(n.y, Int128{at.y}) +
              multiply<3>(n.z, Int128{at.z})};
}

}  // namespace

std::array<double, 3> decimal_place(const GeometryTable& table,
                                    std::int32_t vertex, int digits,
                                    bool& is_rounded) {
  Int128 divisor = 1;
  std::int64_t fives = 1;
  for (int i = 0; i < digits; ++i) {
    divisor *= 10;
    fives *= 5;
  }
  const TableVertex& v = table.vertex(vertex);
  if (v.is_grid()) {
    // Both are doubles, and 5^22 is less than 2^53.
    const GridPoint p = v.point();
    is_rounded |= p.x % fives != 0 || p.y % fives != 0 || p.z % fives != 0;
    const auto by = static_cast<double>(divisor);
    return {v.approximate.x / by, v.approximate.y / by, v.approximate.z / by};
  }
  // Cramer's rule: the offsets weigh the cross products of the other two.
  std::array<OffsetPlane, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = offset_plane(table, v.planes[i]);
  std::array<Number, 3> c{};
  Number below{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Normal& q = p[(i + 1) % 3].normal;
    const Normal& r = p[(i + 2) % 3].normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t s = (k + 1) % 3, t = (k + 2) % 3;
      const Wide<4> product = multiply<4>(q[s], r[t]) - multiply<4>(q[t], r[s]);
      c[k] = c[k] + multiply<8>(p[i].offset, product);
      if (i == 0) below = below + multiply<8>(p[0].normal[k], product);
    }
  }
  if (below.is_negative()) {
    below = -below;
    for (Number& value : c) value = -value;
  }
  below = multiply<8>(below, divisor);
  std::array<double, 3> at;
  for (std::size_t k = 0; k < 3; ++k) {
    bool is_one_rounded = false;
    at[k] = quotient(c[k], below, is_one_rounded);
    is_rounded |= is_one_rounded;
  }
  return at;
}

}  // namespace halfspace::fast
