#include "triangulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <random>

#include "chain_boxes.hpp"
#include "halfspace/int128.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::io {
namespace {

using Polygon = std::vector<GridPoint>;
using Triangles = std::vector<std::array<std::size_t, 3>>;

Int128 twice_area(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x);
}

/// A number from 0 to `count` - 1.
std::int64_t draw(std::mt19937& random, std::int64_t count) {
  return static_cast<std::int64_t>(random()) % count;
}

/// How often each directed edge is used more than its reverse.
using Chain = std::map<std::pair<GridPoint, GridPoint>, int>;

void add_edge(Chain& chain, const GridPoint& a, const GridPoint& b) {
  if (a == b) return;
  if (b < a) {
    if (--chain[{b, a}] == 0) chain.erase({b, a});
  } else {
    if (++chain[{a, b}] == 0) chain.erase({a, b});
  }
}

Chain boundary_of(const Polygon& polygon) {
  Chain chain;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    add_edge(chain, polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return chain;
}

Chain boundary_of(const Polygon& polygon, const Triangles& triangles) {
  Chain chain;
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      add_edge(chain, polygon[t[i]], polygon[t[(i + 1) % 3]]);
    }
  }
  return chain;
}

/// In a plane z = constant, counterclockwise: triangles that all turn left and
/// whose boundaries add up to the polygon's cover each point as often as the
/// polygon goes round it, which is once inside and never outside.
void expect_tiles(const Polygon& polygon) {
  const Triangles triangles = triangulate(polygon);
  EXPECT_FALSE(triangles.empty());
  for (const auto& [a, b, c] : triangles) {
    EXPECT_TRUE(twice_area(polygon[a], polygon[b], polygon[c]) > 0);
  }
  EXPECT_EQ(boundary_of(polygon), boundary_of(polygon, triangles));
}

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
  for (int i = 0; i < 3000; ++i) {
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

/// A circle with waves.
Polygon waves(int count) {
  Polygon polygon;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / count;
    const double radius = 1e9 * (1 + 0.1 * std::sin(40 * angle));
    polygon.push_back({std::llround(radius * std::cos(angle)),
                       std::llround(radius * std::sin(angle)), 0});
  }
  return polygon;
}

TEST(Triangulate, TilesWhatHasAsManyCornersAsMayBe) {
  expect_tiles(waves(static_cast<int>(kMaxEarCorners)));
}

bool holds(const std::array<Flat, 3>& triangle, const Flat& p) {
  return turn(triangle[0], triangle[1], p) >= 0 &&
         turn(triangle[1], triangle[2], p) >= 0 &&
         turn(triangle[2], triangle[0], p) >= 0;
}

TEST(ChainBoxes, FindEveryEdgeWithAPointInTheTriangle) {
  std::mt19937 random(3);
  std::size_t inside = 0, found = 0, all = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::size_t count = 1 + random() % 40;
    const auto point = [&] {
      return Flat{2 * draw(random, 12), 2 * draw(random, 12)};
    };
    std::vector<std::pair<Flat, Flat>> edges;
    ChainBoxes boxes(count);
    for (std::size_t e = 0; e < count; ++e) {
      edges.emplace_back(point(), point());
      boxes.set(e, edges[e].first, edges[e].second);
    }
    const std::size_t gone = random() % count;
    boxes.remove(gone);
    std::array<Flat, 3> triangle{point(), point(), point()};
    if (turn(triangle[0], triangle[1], triangle[2]) < 0)
      std::swap(triangle[1], triangle[2]);
    if (turn(triangle[0], triangle[1], triangle[2]) == 0) continue;
    std::vector<bool> told(count);
    EXPECT_FALSE(boxes.any(triangle, [&](std::size_t e) {
      EXPECT_FALSE(told[e]);
      told[e] = true;
      ++found;
      return false;
    }));
    EXPECT_FALSE(told[gone]);
    for (std::size_t e = 0; e < count; ++e) {
      const auto& [p, q] = edges[e];
      const Flat middle{(p.u + q.u) / 2, (p.v + q.v) / 2};
      const bool is_inside =
          holds(triangle, p) || holds(triangle, q) || holds(triangle, middle);
      if (is_inside && e != gone) ++inside;
      EXPECT_TRUE(told[e] || !is_inside || e == gone);
    }
    all += count;
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_LT(found, all * 3 / 4);
}

TEST(ChainBoxes, LookAtFewEdgesOfALongChain) {
  const Polygon polygon = waves(20000);
  const auto at = [&](std::size_t i) {
    const GridPoint& p = polygon[i % polygon.size()];
    return Flat{p.x, p.y};
  };
  ChainBoxes boxes(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i)
    boxes.set(i, at(i), at(i + 1));
  std::size_t looked = 0, triangles = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::array<Flat, 3> ear{at(i), at(i + 1), at(i + 2)};
    if (turn(ear[0], ear[1], ear[2]) <= 0) continue;
    ++triangles;
    boxes.any(ear, [&](std::size_t) {
      ++looked;
      return false;
    });
  }
  EXPECT_GT(triangles, 10000u);
  EXPECT_LT(looked, 8 * triangles);
}

TEST(Triangulate, IsQuadraticOnASpiralAndOnATangle) {
  Polygon spiral;
  constexpr int kCorners = 4000;
  for (int i = 0; i < 2 * kCorners; ++i) {
    const int j = i < kCorners ? i : 2 * kCorners - 1 - i;
    const double radius = 1000.0 * j + (i < kCorners ? 0 : 4000 * 3.0);
    spiral.push_back({std::llround(radius * std::cos(j / 10.0)),
                      std::llround(radius * std::sin(j / 10.0)), 0});
  }
  std::mt19937 random(9);
  Polygon tangle;
  for (int i = 0; i < kCorners; ++i) {
    tangle.push_back({draw(random, 100000), draw(random, 100000), 0});
  }
  for (const Polygon& polygon : {spiral, tangle}) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_FALSE(triangulate(polygon).empty());
    const std::chrono::duration<double> spent =
        std::chrono::steady_clock::now() - start;
    // A cubic algorithm takes hours.
    EXPECT_LT(spent.count(), 60);
  }
}

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
    const auto of_plane = [&](std::int64_t u, std::int64_t v) {
      switch (i % 6) {
        case 0:
          return GridPoint{u, v, a};
        case 1:
          return GridPoint{-a, u, v};
        case 2:
          return GridPoint{v, 0, u};
        case 3:
          return GridPoint{u, v, -u};
        case 4:
          return GridPoint{v, -v, u};
        default:
          return GridPoint{u, v, v};
      }
    };
    constexpr std::pair<int, int> kRound[] = {
        {-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}};
    Polygon polygon;
    for (const auto& [u, v] : kRound) {
      if (draw(random, 5) < 3) polygon.push_back(of_plane(u * a, v * a));
    }
    if (draw(random, 3) == 0)
      std::shuffle(polygon.begin(), polygon.end(), random);
    if (draw(random, 8) == 0) polygon.push_back(of_plane(0, 0));
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
