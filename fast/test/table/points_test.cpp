#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace halfspace::fast
