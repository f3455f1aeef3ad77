#include "canonical/line_plane.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <random>

#include "canonical/big_vector.hpp"
#include "canonical/own_grid.hpp"

namespace halfspace::fast {
namespace {

class LinePlanes : public ::testing::Test {
 protected:
  std::int64_t number() {
    return static_cast<std::int64_t>(random_() % 19) - 9;
  }
  GridPoint point() { return {number(), number(), number()}; }
  /// A plane through the two points, or nothing where the third is with them on
  /// a line.
  std::optional<std::int32_t> plane_by(const GridPoint& u, const GridPoint& v) {
    const GridPoint w = point();
    const auto d = difference(u, v), e = difference(u, w);
    if (cross<26>(d, e) == Vector3<std::int64_t>{}) return std::nullopt;
    return table_.add_plane({u, v, w}).plane;
  }
  std::int32_t along_axis(const GridPoint& u, const GridPoint& v,
                          std::int32_t face) {
    const BigVector n = to_big_vector(table_.normal(face));
    int axis = 0;
    for (const int k : {1, 2}) {
      if (abs(n[static_cast<std::size_t>(k)]) >
          abs(n[static_cast<std::size_t>(axis)]))
        axis = k;
    }
    return table_.add_line_plane(table_.add_point(u), table_.add_point(v),
                                 axis);
  }

  GeometryTable table_{26};
  std::mt19937 random_{5};
};

/// Through two points, and whichever other plane there is through them.
TEST_F(LinePlanes, AreThoseThatTwoPointsOfTheLineGive) {
  int found = 0, divided = 0;
  for (int k = 0; k < 2000; ++k) {
    const GridPoint u = point(), v = point();
    if (u == v) continue;
    const auto face = plane_by(u, v), other = plane_by(u, v);
    if (!face || !other || *face == *other) continue;
    const std::int32_t expected = along_axis(u, v, *face);
    const auto line = line_plane_of(table_, *face, *other);
    ASSERT_TRUE(line);
    EXPECT_EQ(line->normal, table_.reduced_normal(expected));
    EXPECT_EQ(line->offset, offset_of(table_, expected));
    EXPECT_EQ(line->below, 1);
    ++found;
  }
  // A line with no points of the grid has such a plane, too, at a quotient.
  for (int k = 0; k < 600; ++k) {
    const auto face = plane_by(point(), point());
    const auto other = plane_by(point(), point());
    if (!face || !other) continue;
    const BigVector n = to_big_vector(table_.normal(*face));
    const BigVector m = to_big_vector(table_.normal(*other));
    if (cross(n, m) == BigVector{}) continue;
    const auto line = line_plane_of(table_, *face, *other);
    if (!line) continue;
    const BigVector along = cross(n, m);
    const BigVector normal = to_big_vector(line->normal);
    EXPECT_EQ(dot(normal, along), 0);
    // The point nearest to the origin, times the square of `along`.
    const BigInteger p = dot(n, to_big_vector({table_.plane(*face).origin.x,
                                               table_.plane(*face).origin.y,
                                               table_.plane(*face).origin.z}));
    const BigInteger q = dot(m, to_big_vector({table_.plane(*other).origin.x,
                                               table_.plane(*other).origin.y,
                                               table_.plane(*other).origin.z}));
    const BigVector a = cross(m, along), b = cross(along, n);
    BigVector at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = p * a[i] + q * b[i];
    EXPECT_EQ(dot(normal, at) * line->below, line->offset * dot(along, along));
    divided += line->below != 1 ? 1 : 0;
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(divided, 50);
}

}  // namespace
}  // namespace halfspace::fast
