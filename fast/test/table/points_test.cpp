#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "table/shared_table.hpp"

namespace halfspace::fast {
namespace {

TEST(Points, PointsAddedTogetherAreThoseAddedAlone) {
  std::mt19937_64 random(10);
  for (const std::size_t count : {0u, 1u, 31u, 32u, 33u, 500u}) {
    std::vector<GridPoint> points;
    const auto number = [&] {
      return static_cast<std::int64_t>(random() % 7) - 3;
    };
    for (std::size_t i = 0; i < count; ++i)
      points.push_back({number(), number(), number()});
    GeometryTable together(26), alone(26);
    std::vector<std::int32_t> ids, others;
    together.add_points(points, ids);
    for (const GridPoint& point : points)
      others.push_back(alone.add_point(point));
    ASSERT_EQ(ids, others);
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_EQ(together.vertex(ids[i]).point(), points[i]);
  }
}

/// Far out on the widest grid, too, where doubles are off by some steps.
TEST(Points, MeetsOnTheGridArePointsOfTheGrid) {
  std::mt19937_64 random(11);
  for (const int bits : {26, 40, 54}) {
    const std::int64_t limit = std::int64_t{1} << (bits - 1);
    const auto number = [&](std::int64_t most) {
      return static_cast<std::int64_t>(
                 random() % static_cast<std::uint64_t>(2 * most - 1)) -
             most + 1;
    };
    GeometryTable table(bits);
    for (int round = 0; round < 300; ++round) {
      const GridPoint at{number(limit), number(limit), number(limit)};
      // Each plane through the point and two others, on as large numbers.
      std::array<std::int32_t, 3> planes;
      for (std::int32_t& plane : planes) {
        plane = table
                    .add_plane({at,
                                {number(limit), number(limit), number(limit)},
                                {number(limit), number(limit), number(limit)}})
                    .plane;
      }
      const std::int32_t v = table.meet(planes[0], planes[1], planes[2]);
      ASSERT_TRUE(table.vertex(v).is_grid());
      ASSERT_EQ(table.vertex(v).point(), at);
      ASSERT_EQ(table.add_point(at), v);
      // Where an edge meets any other plane is beside the grid.
      const std::array<GridPoint, 3> corners{
          GridPoint{number(limit), 0, 1}, GridPoint{0, number(limit), 1},
          GridPoint{number(limit), number(limit), 2}};
      const std::int32_t beside =
          table.meet(planes[0], planes[1], table.add_plane(corners).plane);
      ASSERT_FALSE(table.vertex(beside).is_grid());
    }
  }
}

}  // namespace
}  // namespace halfspace::fast
