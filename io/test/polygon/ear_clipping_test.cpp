#include "polygon/ear_clipping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <random>

#include "halfspace/int128.hpp"
#include "polygon/chain_boxes.hpp"
#include "polygon/polygons.hpp"
#include "polygon/tiling.hpp"

namespace halfspace::io {
namespace {

using samples::boundary_of;
using samples::draw;
using samples::expect_tiles;
using samples::Polygon;
using samples::Triangles;

/// The polygon, started at each of its corners, and seen from each side of
/// each axis.
void expect_tiles_anyhow(const Polygon& polygon) {
  Polygon turned = polygon;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    expect_tiles(turned);
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool flip : {false, true}) {
      Polygon other = polygon;
      for (GridPoint& p : other) {
        if (axis == 1) p = {p.z, p.x, p.y};
        if (axis == 2) p = {p.y, p.z, p.x};
      }
      if (flip) std::reverse(other.begin(), other.end());
      const Triangles triangles = triangulate(other);
      EXPECT_EQ(triangles.size(), triangulate(polygon).size());
      EXPECT_EQ(boundary_of(other), boundary_of(other, triangles));
    }
  }
}

TEST(Triangulate, TilesPolygonsWithStraightCorners) {
  expect_tiles_anyhow({{0, 0, 7}, {2, 0, 7}, {4, 0, 7}, {0, 4, 7}});
  expect_tiles_anyhow({{0, 0, 0},
                       {1, 0, 0},
                       {2, 0, 0},
                       {4, 0, 0},
                       {2, 2, 0},
                       {0, 4, 0},
                       {0, 3, 0},
                       {0, 1, 0}});
  expect_tiles_anyhow({{0, 0, 0},
                       {1, 0, 0},
                       {4, 0, 0},
                       {4, 4, 0},
                       {3, 4, 0},
                       {1, 1, 0},
                       {0, 4, 0}});
}

TEST(Triangulate, TilesAPolygonWithAHoleOnABridge) {
  expect_tiles_anyhow({{0, 0, 0},
                       {9, 0, 0},
                       {9, 9, 0},
                       {0, 9, 0},
                       {0, 0, 0},
                       {3, 3, 0},
                       {3, 6, 0},
                       {6, 6, 0},
                       {6, 3, 0},
                       {3, 3, 0}});
}

TEST(Triangulate, TilesAPolygonWithTwoHolesOnOneCorner) {
  expect_tiles_anyhow({{0, 0, 0},
                       {9, 0, 0},
                       {9, 9, 0},
                       {0, 9, 0},
                       {0, 0, 0},
                       {1, 3, 0},
                       {1, 5, 0},
                       {3, 5, 0},
                       {3, 3, 0},
                       {1, 3, 0},
                       {0, 0, 0},
                       {5, 3, 0},
                       {5, 5, 0},
                       {7, 5, 0},
                       {7, 3, 0},
                       {5, 3, 0}});
}

TEST(Triangulate, TilesAHoleThatTouchesTheRim) {
  expect_tiles_anyhow({{0, 0, 0},
                       {8, 0, 0},
                       {8, 8, 0},
                       {0, 8, 0},
                       {0, 4, 0},
                       {4, 6, 0},
                       {4, 2, 0},
                       {0, 4, 0}});
}

TEST(Triangulate, TilesAPolygonWithTheLeastDent) {
  // The last corner is a step of the grid inside of the others' triangle.
  expect_tiles_anyhow({{0, 3, 0}, {0, 0, 0}, {3, 1, 0}, {1, 2, 0}});
}

TEST(Triangulate, ClipsTheFirstEarInTheCornersOrder) {
  EXPECT_EQ(triangulate(Polygon{{4, 0, 0}, {1, 1, 0}, {0, 4, 0}, {0, 0, 0}}),
            (Triangles{{3, 0, 1}, {1, 2, 3}}));
}

TEST(Triangulate, SeesAFigureOfEightAlongItsNormal) {
  Polygon eight = {{0, 0, 5}, {4, 4, 5}, {4, 0, 5}, {0, 4, 5}};
  const Triangles triangles = triangulate(eight);
  EXPECT_EQ(triangles.size(), 2u);
  for (int axis = 0; axis < 2; ++axis) {
    for (GridPoint& p : eight) p = {p.z, p.x, p.y};
    EXPECT_EQ(triangulate(eight), triangles);
  }
}

/// A wall along a spiral: it has two ears at a time.
Polygon spiral(int corners) {
  Polygon polygon;
  for (int i = 0; i < 2 * corners; ++i) {
    const int j = i < corners ? i : 2 * corners - 1 - i;
    const double radius = 1000.0 * j + (i < corners ? 0 : 4000 * 3.0);
    polygon.push_back({std::llround(radius * std::cos(j / 10.0)),
                       std::llround(radius * std::sin(j / 10.0)), 0});
  }
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

TEST(Triangulate, TilesSpirals) {
  for (const int corners : {3, 20, 800}) expect_tiles(spiral(corners));
}

TEST(Triangulate, LetsASlitGo) {
  const Polygon slit = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0},
                        {2, 2, 0}, {4, 4, 0}, {0, 4, 0}};
  expect_tiles(slit);
  EXPECT_TRUE(
      triangulate(Polygon{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {4, 0, 0}}).empty());
}

TEST(Triangulate, TilesRandomStarsOfSmallIntegers) {
  // Corners sorted by angle round the origin, so the polygon is simple; small
  // integers put many of them on common lines.
  std::mt19937 random(5);
  for (int i = 0; i < 400; ++i) {
    std::map<std::pair<int, int>, GridPoint> by_direction;
    const auto count = 5 + random() % 20;
    for (std::size_t j = 0; j < count; ++j) {
      const int x = static_cast<int>(random() % 15) - 7;
      const int y = static_cast<int>(random() % 15) - 7;
      const int divisor = std::gcd(x, y);
      if (divisor != 0) {
        by_direction[{x / divisor, y / divisor}] = {x, y, 0};
      }
    }
    for (const auto& [x, y] : {std::pair{9, 0}, {0, 9}, {-9, 0}, {0, -9}}) {
      by_direction[{x / 9, y / 9}] = {x, y, 0};
    }
    Polygon polygon;
    for (const auto& [direction, point] : by_direction) {
      polygon.push_back(point);
    }
    std::sort(polygon.begin(), polygon.end(),
              [](const GridPoint& a, const GridPoint& b) {
                return std::atan2(static_cast<double>(a.y),
                                  static_cast<double>(a.x)) <
                       std::atan2(static_cast<double>(b.y),
                                  static_cast<double>(b.x));
              });
    expect_tiles(polygon);
  }
}

TEST(Triangulate, TilesACombInTheLargestGrid) {
  const std::int64_t a = (std::int64_t{1} << 53) - 1;
  Polygon comb = {{a, -a, a}, {a, a, a}};
  for (std::int64_t i = 40; i >= -40; --i) {
    comb.push_back({i * (a / 41), i % 2 == 0 ? a - 1 : -a + 1, a});
  }
  comb.push_back({-a, a, a});
  comb.push_back({-a, -a, a});
  expect_tiles(comb);
}

TEST(Triangulate, EndsOnWhateverChainOfPoints) {
  std::mt19937 random(7);
  for (int i = 0; i < 1500; ++i) {
    Polygon polygon;
    const std::size_t count = 3 + random() % 30;
    const std::int64_t range = i % 2 == 0 ? 4 : 100;
    while (polygon.size() < count) {
      const GridPoint p = {draw(random, range), draw(random, range),
                           i % 3 == 0 ? draw(random, range) : 0};
      if (polygon.empty() || p != polygon.back()) polygon.push_back(p);
    }
    if (polygon.front() == polygon.back()) polygon.pop_back();
    if (shape_of(polygon) == Shape::kNoArea) continue;
    const Triangles triangles = triangulate(polygon);
    EXPECT_LE(triangles.size(), polygon.size() - 2);
    for (const auto& [a, b, c] : triangles) {
      EXPECT_NE(shape_of(Polygon{polygon[a], polygon[b], polygon[c]}),
                Shape::kNoArea);
    }
  }
}

/// A polygon of the plane with a corner at each unit of its sides.
std::vector<std::array<double, 2>> with_corners_on_sides(
    const std::vector<std::array<double, 2>>& corners) {
  std::vector<std::array<double, 2>> result;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& [x, y] = corners[i];
    const auto& [to_x, to_y] = corners[(i + 1) % corners.size()];
    const double count = std::max(std::abs(to_x - x), std::abs(to_y - y));
    for (double k = 0; k < count; ++k) {
      result.push_back(
          {x + (to_x - x) * k / count, y + (to_y - y) * k / count});
    }
  }
  return result;
}

/// In a plane that stands anyhow, rounded to a multiple of `step`.
Polygon stood_anyhow(const std::vector<std::array<double, 2>>& corners,
                     double size, double step, std::mt19937& random) {
  std::array<double, 6> turn;
  double upright = 0;
  while (std::abs(upright) < 0.3) {
    for (double& entry : turn)
      entry = static_cast<double>(draw(random, 1000)) / 1000;
    upright = turn[0] * turn[4] - turn[1] * turn[3];
  }
  Polygon polygon;
  for (const auto& [x, y] : corners) {
    std::array<std::int64_t, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const double at = size * (turn[i] * x + turn[i + 3] * y);
      p[i] = std::llround(at / step) * static_cast<std::int64_t>(step);
    }
    polygon.push_back({p[0], p[1], p[2]});
  }
  return polygon;
}

/// How many triangles face another way than the polygon does.
std::size_t turned_over(const Polygon& polygon) {
  using Normal = std::array<double, 3>;
  const auto normal = [&](std::size_t a, std::size_t b, std::size_t c) {
    const auto difference = [&](std::size_t i, std::size_t j) {
      const GridPoint &p = polygon[i], &q = polygon[j];
      return Normal{static_cast<double>(p.x - q.x),
                    static_cast<double>(p.y - q.y),
                    static_cast<double>(p.z - q.z)};
    };
    const Normal u = difference(b, a), v = difference(c, a);
    return Normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                  u[0] * v[1] - u[1] * v[0]};
  };
  Normal whole{};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Normal part = normal(0, i, i + 1);
    for (std::size_t k = 0; k < 3; ++k) whole[k] += part[k];
  }
  std::size_t count = 0;
  for (const auto& [a, b, c] : triangulate(polygon)) {
    const Normal n = normal(a, b, c);
    count += n[0] * whole[0] + n[1] * whole[1] + n[2] * whole[2] > 0 ? 0u : 1u;
  }
  return count;
}

TEST(Triangulate, CutsNoThinEarsFromSidesOfManyCorners) {
  const std::vector<std::vector<std::array<double, 2>>> shapes = {
      {{0, 0}, {100, 0}, {100, 100}, {0, 100}},
      {{0, 0}, {100, 0}, {100, 40}, {40, 40}, {40, 100}, {0, 100}},
      {{0, 0}, {90, 0}, {40, 70}},
      {{0, 0}, {100, 0}, {100, 2}, {0, 2}},
      // A hole on a bridge.
      {{0, 0},
       {100, 0},
       {100, 100},
       {0, 100},
       {0, 0},
       {30, 40},
       {30, 70},
       {80, 70},
       {80, 40},
       {30, 40}}};
  std::mt19937 random(11);
  for (const auto& shape : shapes) {
    const auto corners = with_corners_on_sides(shape);
    for (int i = 0; i < 20; ++i) {
      // By a step, in a fine grid and in a coarse one, and by as much as
      // decimals of a file do.
      EXPECT_EQ(turned_over(stood_anyhow(corners, 1e4, 1, random)), 0u);
      EXPECT_EQ(turned_over(stood_anyhow(corners, 100, 1, random)), 0u);
      EXPECT_EQ(turned_over(stood_anyhow(corners, 1e4, 16, random)), 0u);
    }
  }
}

/// A side of many corners that rounding has bent outwards by a step: the edge
/// from its one end to the other would leave a thin polygon beside it.
TEST(Triangulate, LeavesNoThinPolygonBesideAnEar) {
  Polygon polygon = {{0, 0, 0}};
  for (std::int64_t i = 1; i < 10; ++i) polygon.push_back({1000 * i, -1, 0});
  polygon.push_back({9990, -100, 0});
  polygon.push_back({10000, 0, 0});
  polygon.push_back({5000, 8000, 0});
  const Triangles triangles = triangulate(polygon);
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
  for (const auto& [a, b, c] : triangles) {
    const auto flat = [&](std::size_t i) {
      return Flat{polygon[i].x, polygon[i].y};
    };
    EXPECT_GT(turn(flat(a), flat(b), flat(c)), 5 * 10000);
  }
}

TEST(Triangulate, TilesWhatHasManyCorners) {
  expect_tiles(samples::waves(20000));
}

TEST(Triangulate, IsQuadraticOnASpiralAndOnATangle) {
  constexpr int kCorners = 4000;
  std::mt19937 random(9);
  Polygon tangle;
  for (int i = 0; i < kCorners; ++i) {
    tangle.push_back({draw(random, 100000), draw(random, 100000), 0});
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(triangulate(tangle).empty());
  expect_tiles(spiral(kCorners));
  const std::chrono::duration<double> spent =
      std::chrono::steady_clock::now() - start;
  // A cubic algorithm takes hours.
  EXPECT_LT(spent.count(), 60);
}

}  // namespace
}  // namespace halfspace::io
