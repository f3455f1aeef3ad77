#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "halfspace/scene.hpp"
#include "planes.hpp"
#include "polygon/ear_clipping.hpp"
#include "polygon/polygons.hpp"

namespace halfspace::io {
namespace {

using samples::draw;
using samples::Polygon;

TEST(ShapeOf, TellsWhatAPolygonIs) {
  using enum Shape;
  EXPECT_EQ(shape_of(Polygon{{0, 0, 0}, {1, 0, 0}}), kNoArea);
  EXPECT_EQ(shape_of(Polygon{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}}),
            kNoArea);
  EXPECT_EQ(shape_of(Polygon{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), kConvex);
  EXPECT_EQ(
      shape_of(Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}),
      kConvex);
  EXPECT_EQ(shape_of(Polygon{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}),
            kOther);
  EXPECT_EQ(shape_of(Polygon{
                {0, 10, 0}, {-6, -8, 0}, {10, 3, 0}, {-10, 3, 0}, {6, -8, 0}}),
            kOther);
  EXPECT_EQ(shape_of(Polygon{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}}),
            kOther);
  for (const int bits : {26, 40, 54}) {
    const std::int64_t a = (std::int64_t{1} << (bits - 1)) - 1;
    const Polygon square = {{-a, -a, a}, {a, -a, -a}, {a, a, -a}, {-a, a, a}};
    Polygon bent = square;
    --bent[3].z;
    EXPECT_EQ(shape_of(square), kConvex);
    EXPECT_EQ(shape_of(bent), kOther);
  }
}

/// What make_scene() says of the polygon, which is held against S1.3 itself.
Shape shape_by_scene(const Polygon& polygon) {
  SceneData data;
  data.grid_bits = 54;
  data.vertices = polygon;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    data.corners.push_back(static_cast<VertexId>(i));
  data.first_corner.push_back(static_cast<std::uint32_t>(polygon.size()));
  data.colors.push_back({});
  const Result<Scene> scene = make_scene(std::move(data));
  if (scene) return Shape::kConvex;
  return scene.error().code == ErrorCode::kZeroArea ? Shape::kNoArea
                                                    : Shape::kOther;
}

TEST(ShapeOf, IsConvexWhereAScenesPolygonsAre) {
  const std::int64_t a = (std::int64_t{1} << 53) - 1;
  std::mt19937 random(5);
  std::array<int, 3> counts{};
  for (int i = 0; i < 20000; ++i) {
    // Corners on a square of nine points in some plane, or off it; in a row
    // that is turned or mixed, at the ends of the largest grid.
    const auto corner = [&](int u, int v) {
      const GridPoint p = in_plane(i % 6, u, v);
      return GridPoint{a * p.x, a * p.y, a * p.z};
    };
    constexpr std::pair<int, int> kRound[] = {
        {-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}};
    Polygon polygon;
    for (const auto& [u, v] : kRound) {
      if (draw(random, 5) < 3) polygon.push_back(corner(u, v));
    }
    if (draw(random, 3) == 0)
      std::shuffle(polygon.begin(), polygon.end(), random);
    if (draw(random, 8) == 0) polygon.push_back(corner(0, 0));
    if (polygon.size() > 3 && draw(random, 8) == 0) --polygon[2].x;
    if (!polygon.empty()) {
      std::rotate(polygon.begin(),
                  polygon.begin() + draw(random, std::ssize(polygon)),
                  polygon.end());
    }
    if (draw(random, 2) == 0) std::reverse(polygon.begin(), polygon.end());
    if (polygon.size() < 3) {
      ASSERT_EQ(shape_of(polygon), Shape::kNoArea);
      continue;
    }
    const Shape shape = shape_by_scene(polygon);
    ASSERT_EQ(shape_of(polygon), shape) << i;
    ++counts[static_cast<std::size_t>(shape)];
  }
  EXPECT_GT(counts[0], 100);
  EXPECT_GT(counts[1], 1500);
  EXPECT_GT(counts[2], 1500);
}

TEST(ShapeOf, TellsSpikesWhicheverWayTheyPoint) {
  for (const std::int64_t length : {1, 3, 7}) {
    const Polygon spike = {
        {0, 0, 0}, {4, 4, 4}, {4 - length, 4 - length, 4 - length}, {0, 9, 1}};
    for (std::size_t first = 0; first < 4; ++first) {
      for (int axis = 0; axis < 3; ++axis) {
        for (int signs = 0; signs < 8; ++signs) {
          Polygon polygon = spike;
          std::rotate(polygon.begin(),
                      polygon.begin() + static_cast<std::ptrdiff_t>(first),
                      polygon.end());
          for (GridPoint& p : polygon) {
            if (axis == 1) p = {p.z, p.x, p.y};
            if (axis == 2) p = {p.y, p.z, p.x};
            if (signs & 1) p.x = -p.x;
            if (signs & 2) p.y = -p.y;
            if (signs & 4) p.z = -p.z;
          }
          EXPECT_EQ(shape_of(polygon), Shape::kOther);
        }
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::io
