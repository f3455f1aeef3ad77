#include "solid/lattice_point.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>

#include "exact/big_rational.hpp"
#include "halfspace/big_integer.hpp"

namespace halfspace::fast {
namespace {

BigInteger along(const Vector3<Int128>& n, const GridPoint& p) {
  return to_big<BigInteger>(n.x) * p.x + to_big<BigInteger>(n.y) * p.y +
         to_big<BigInteger>(n.z) * p.z;
}

/// The first of all points of a small box, by the words of the definition.
std::optional<GridPoint> sought(const std::array<std::int64_t, 3>& n,
                                std::int64_t d, int base) {
  constexpr std::int64_t kReach = 40;
  std::int64_t step = 1;
  while (d != 0 && d % (step * base) == 0) step *= base;
  std::optional<GridPoint> best;
  const auto size = [](const GridPoint& p) {
    return p.x * p.x + p.y * p.y + p.z * p.z;
  };
  const std::int64_t most = kReach / step * step;
  for (std::int64_t x = -most; x <= most; x += step) {
    for (std::int64_t y = -most; y <= most; y += step) {
      for (std::int64_t z = -most; z <= most; z += step) {
        const GridPoint p = {x, y, z};
        if (n[0] * x + n[1] * y + n[2] * z != d) continue;
        if (!best || size(p) < size(*best)) best = p;
      }
    }
  }
  return best;
}

TEST(LatticePoint, IsTheNearestOfTheCoarsestGrid) {
  std::mt19937 random(3);
  const auto number = [&](int reach) {
    return static_cast<std::int64_t>(random() %
                                     static_cast<unsigned>(2 * reach + 1)) -
           reach;
  };
  int tried = 0;
  int coarser = 0;
  while (tried < 300) {
    const std::int64_t a = number(4), b = number(4), c = number(4);
    if (std::gcd(a, std::gcd(b, c)) != 1) continue;
    const Vector3<Int128> n = {a, b, c};
    const int base = tried % 2 == 0 ? 2 : 10;
    const GridPoint p = {number(9), number(9), number(9)};
    const std::int64_t d = a * p.x + b * p.y + c * p.z;
    const auto expected = sought({a, b, c}, d, base);
    ASSERT_TRUE(expected);
    EXPECT_EQ(lattice_point(n, p, base, 26), *expected)
        << a << ' ' << b << ' ' << c;
    coarser += d != 0 && d % base == 0 ? 1 : 0;
    ++tried;
  }
  EXPECT_GT(coarser, 50);
}

/// Another point of the plane, or a finer grid, does not matter, but where a
/// triangle is nearly as large as the grid: then there may be no other point.
TEST(LatticePoint, DependsOnThePlaneAlone) {
  std::mt19937_64 random(4);
  int others = 0;
  for (const int bits : {26, 40, 54}) {
    for (int k = 0; k < 300; ++k) {
      const bool is_large = k % 5 == 0;
      const auto number = [&](int size) {
        const std::uint64_t side = std::uint64_t{1} << size;
        return static_cast<std::int64_t>(random() % side) -
               static_cast<std::int64_t>(side / 2);
      };
      const GridPoint p = {number(bits - 2), number(bits - 2),
                           number(bits - 2)};
      const auto beside = [&] {
        const int size = is_large ? bits - 2 : 3 + k % (bits - 12);
        return GridPoint{p.x + number(size), p.y + number(size),
                         p.z + number(size)};
      };
      const GridPoint q = beside(), r = beside();
      const auto minus = [](const GridPoint& x, const GridPoint& y) {
        return Vector3<Int128>{x.x - y.x, x.y - y.y, x.z - y.z};
      };
      const Vector3<Int128> u = minus(q, p), v = minus(r, p);
      const Vector3<Int128> n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z,
                                 u.x * v.y - u.y * v.x};
      if (n.x == 0 && n.y == 0 && n.z == 0) continue;
      const int base = k % 2 == 0 ? 2 : 10;
      const GridPoint at = lattice_point(n, p, base, bits);
      EXPECT_EQ(along(n, at), along(n, p));
      EXPECT_TRUE(fits(at.x, bits) && fits(at.y, bits) && fits(at.z, bits));
      if (is_large) continue;
      others += at != p ? 1 : 0;
      EXPECT_EQ(lattice_point(n, q, base, bits), at);
      EXPECT_EQ(lattice_point(n, at, base, bits), at);
      const auto finer = [base](const GridPoint& x) {
        return GridPoint{x.x * base, x.y * base, x.z * base};
      };
      if (bits < 54) {
        EXPECT_EQ(lattice_point(n, finer(r), base, 54), finer(at));
      }
    }
  }
  EXPECT_GT(others, 650);
}

TEST(LatticePoint, OfAPlaneAcrossAnAxisIsOnTheAxis) {
  EXPECT_EQ(lattice_point({0, 1, 0}, {3, -5, 7}, 2, 26), (GridPoint{0, -5, 0}));
  EXPECT_EQ(lattice_point({1, 2, 3}, {3, 0, -1}, 2, 26), (GridPoint{0, 0, 0}));
}

}  // namespace
}  // namespace halfspace::fast
