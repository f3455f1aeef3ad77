#include "canonical/lattice_point.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>

#include "halfspace/big_integer.hpp"

namespace halfspace::fast {
namespace {

BigInteger along(const Vector3<Int128>& n, const GridPoint& p) {
  return to_big<BigInteger>(n.x) * p.x + to_big<BigInteger>(n.y) * p.y +
         to_big<BigInteger>(n.z) * p.z;
}

/// The first of all points of a small box, by the words of the definition.
std::optional<GridPoint> sought(const std::array<std::int64_t, 3>& n,
                                std::int64_t d) {
  constexpr std::int64_t kReach = 40;
  std::optional<GridPoint> best;
  const auto size = [](const GridPoint& p) {
    return p.x * p.x + p.y * p.y + p.z * p.z;
  };
  for (std::int64_t x = -kReach; x <= kReach; ++x) {
    for (std::int64_t y = -kReach; y <= kReach; ++y) {
      for (std::int64_t z = -kReach; z <= kReach; ++z) {
        const GridPoint p = {x, y, z};
        if (n[0] * x + n[1] * y + n[2] * z != d) continue;
        if (!best || size(p) < size(*best)) best = p;
      }
    }
  }
  return best;
}

TEST(LatticePoint, IsTheNearest) {
  std::mt19937 random(3);
  const auto number = [&](int reach) {
    return static_cast<std::int64_t>(random() %
                                     static_cast<unsigned>(2 * reach + 1)) -
           reach;
  };
  for (int tried = 0; tried < 300;) {
    const std::int64_t a = number(4), b = number(4), c = number(4);
    if (std::gcd(a, std::gcd(b, c)) != 1) continue;
    const std::int64_t d = number(30);
    const auto expected = sought({a, b, c}, d);
    ASSERT_TRUE(expected);
    EXPECT_EQ(lattice_point({a, b, c}, d), expected)
        << a << ' ' << b << ' ' << c << ' ' << d;
    ++tried;
  }
}

/// On the planes of triangles of any size; far out there may be none.
TEST(LatticePoint, IsNoFartherThanAnyOther) {
  std::mt19937_64 random(4);
  int found = 0, beyond = 0;
  for (int k = 0; k < 600; ++k) {
    const bool is_large = k % 5 == 0;
    const auto number = [&](int size) {
      const std::uint64_t side = std::uint64_t{1} << size;
      return static_cast<std::int64_t>(random() % side) -
             static_cast<std::int64_t>(side / 2);
    };
    const GridPoint p = {number(52), number(52), number(52)};
    const auto beside = [&] {
      const int size = is_large ? 52 : 3 + k % 42;
      return Vector3<Int128>{number(size), number(size), number(size)};
    };
    const Vector3<Int128> u = beside(), v = beside();
    Vector3<Int128> n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z,
                         u.x * v.y - u.y * v.x};
    const BigInteger divisor =
        gcd(to_big<BigInteger>(n.x),
            gcd(to_big<BigInteger>(n.y), to_big<BigInteger>(n.z)));
    if (divisor == 0) continue;
    const auto by = to_int128(divisor);
    n = {n.x / by, n.y / by, n.z / by};
    const auto at = lattice_point(n, along(n, p));
    ++(at ? found : beyond);
    if (!at) {
      EXPECT_TRUE(is_large);
      continue;
    }
    EXPECT_EQ(along(n, *at), along(n, p));
    const auto size = [](const GridPoint& x) {
      return BigInteger(x.x) * x.x + BigInteger(x.y) * x.y +
             BigInteger(x.z) * x.z;
    };
    EXPECT_LE(size(*at), size(p));
  }
  EXPECT_GT(found, 450);
  RecordProperty("beyond", beyond);
}

TEST(LatticePoint, OfAPlaneAcrossAnAxisIsOnTheAxis) {
  EXPECT_EQ(lattice_point({0, 1, 0}, -5), (GridPoint{0, -5, 0}));
  EXPECT_EQ(lattice_point({1, 2, 3}, 0), (GridPoint{0, 0, 0}));
  EXPECT_FALSE(lattice_point({0, 0, 1}, BigInteger(1) << 53));
  EXPECT_EQ(lattice_point({0, 0, 1}, -(BigInteger(1) << 53)),
            (GridPoint{0, 0, -(std::int64_t{1} << 53)}));
}

}  // namespace
}  // namespace halfspace::fast
