#include "rounding/grid_predicates.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "halfspace/int128.hpp"

namespace halfspace::fast {
namespace {

/// On the line: the segment's points are seen at many fractions.
GridPoint scaled(const GridPoint& p, std::int64_t by) {
  return {p.x * by, p.y * by, p.z * by};
}

TEST(FastGridPredicates, SidesAreExactAtTheEndsOfTheGrid) {
  const std::int64_t m = std::int64_t{1} << 53;
  const GridPoint a = {-m, -m, -m}, b = {m, -m, m - 1}, c = {-m, m, -m};
  // A point of the plane, and its neighbours.
  const GridPoint d = {m, m, m - 1};
  EXPECT_EQ(side_of_triangle(a, b, c, d), 0);
  EXPECT_EQ(side_of_triangle(a, b, c, {d.x, d.y, d.z + 1}), 1);
  EXPECT_EQ(side_of_triangle(a, b, c, {d.x, d.y, d.z - 1}), -1);
  EXPECT_EQ(side_of_triangle(a, c, b, {d.x, d.y, d.z - 1}), 1);
}

TEST(FastGridPredicates, PointsOfALineAreFound) {
  EXPECT_TRUE(on_one_line({0, 0, 0}, {3, 6, -9}, {1, 2, -3}));
  EXPECT_FALSE(on_one_line({0, 0, 0}, {3, 6, -9}, {1, 2, -4}));
  EXPECT_FALSE(on_one_line({0, 0, 0}, {3, 0, 0}, {1, 1, 0}));
}

/// In a small box, a segment and a triangle meet where some point of a fine
/// grid of the segment is in the triangle, or they cross between two of them:
/// told by barycentric coordinates in integers.
bool meet_by_clipping(const GridPoint& p, const GridPoint& q,
                      const std::array<GridPoint, 3>& t) {
  // Along the segment, at p + (q - p) k / n, the signs of all edges' planes
  // and of the triangle's plane are linear in k: look at all their zeros.
  using I = Int128;
  const auto sub = [](const GridPoint& u, const GridPoint& v) {
    return std::array<I, 3>{u.x - v.x, u.y - v.y, u.z - v.z};
  };
  const auto cross = [](const std::array<I, 3>& u, const std::array<I, 3>& v) {
    return std::array<I, 3>{u[1] * v[2] - u[2] * v[1],
                            u[2] * v[0] - u[0] * v[2],
                            u[0] * v[1] - u[1] * v[0]};
  };
  const auto dot = [](const std::array<I, 3>& u, const std::array<I, 3>& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  const auto n = cross(sub(t[1], t[0]), sub(t[2], t[0]));
  // Constraints value(p) + s (value(q) - value(p)) >= 0 for 0 <= s <= 1.
  struct Linear {
    I at_p, at_q;
  };
  std::array<Linear, 5> all;
  all[0] = {dot(n, sub(p, t[0])), dot(n, sub(q, t[0]))};
  all[1] = {-all[0].at_p, -all[0].at_q};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto inwards = cross(n, sub(t[(i + 1) % 3], t[i]));
    all[2 + i] = {dot(inwards, sub(p, t[i])), dot(inwards, sub(q, t[i]))};
  }
  // The range of s, as fractions low and high.
  I low = 0, low_by = 1, high = 1, high_by = 1;
  for (const Linear& l : all) {
    if (l.at_p < 0 && l.at_q < 0) return false;
    if (l.at_p >= 0 && l.at_q >= 0) continue;
    const I num = l.at_p < 0 ? -l.at_p : l.at_p;
    const I den = l.at_p < 0 ? l.at_q - l.at_p : l.at_p - l.at_q;
    if (l.at_p < 0) {
      if (num * low_by > low * den) low = num, low_by = den;
    } else {
      if (num * high_by < high * den) high = num, high_by = den;
    }
  }
  return low * high_by <= high * low_by;
}

TEST(FastGridPredicates, SegmentsMeetTrianglesWhereClippingSaysSo) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> at(-3, 3);
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto point = [&] {
      return GridPoint{at(random), at(random), at(random)};
    };
    const std::array<GridPoint, 3> t = {point(), point(), point()};
    const GridPoint p = point(), q = point();
    if (on_one_line(t[0], t[1], t[2]) || p == q) continue;
    const bool expected = meet_by_clipping(p, q, t);
    ASSERT_EQ(meets_triangle(p, q, t[0], t[1], t[2]), expected) << i;
    // The same far from the origin, and large.
    const std::int64_t by = std::int64_t{1} << 50;
    ASSERT_EQ(meets_triangle(scaled(p, by), scaled(q, by), scaled(t[0], by),
                             scaled(t[1], by), scaled(t[2], by)),
              expected);
    met += expected ? 1 : 0;
  }
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace halfspace::fast
