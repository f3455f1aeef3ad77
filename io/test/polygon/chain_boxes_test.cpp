#include "polygon/chain_boxes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "polygon/polygons.hpp"

namespace halfspace::io {
namespace {

using samples::draw;

bool holds(const std::array<Flat, 3>& triangle, const Flat& p) {
  return turn(triangle[0], triangle[1], p) >= 0 &&
         turn(triangle[1], triangle[2], p) >= 0 &&
         turn(triangle[2], triangle[0], p) >= 0;
}

/// By a margin in all four directions.
bool holds_near(const std::array<Flat, 3>& triangle, const Flat& p,
                std::int64_t margin) {
  for (const std::int64_t u : {-margin, std::int64_t{0}, margin}) {
    for (const std::int64_t v : {-margin, std::int64_t{0}, margin}) {
      if (holds(triangle, {p.u + u, p.v + v})) return true;
    }
  }
  return false;
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
    std::vector<bool> reported(count);
    const std::int64_t margin = i % 2 == 0 ? 0 : 3;
    EXPECT_FALSE(boxes.any(triangle, margin, [&](std::size_t e) {
      EXPECT_FALSE(reported[e]);
      reported[e] = true;
      ++found;
      return false;
    }));
    EXPECT_FALSE(reported[gone]);
    for (std::size_t e = 0; e < count; ++e) {
      const auto& [p, q] = edges[e];
      const Flat middle{(p.u + q.u) / 2, (p.v + q.v) / 2};
      const bool is_inside = holds_near(triangle, p, margin) ||
                             holds_near(triangle, q, margin) ||
                             holds_near(triangle, middle, margin);
      if (is_inside && e != gone) ++inside;
      EXPECT_TRUE(reported[e] || !is_inside || e == gone);
    }
    all += count;
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_LT(found, all * 3 / 4);
}

TEST(ChainBoxes, LookAtFewEdgesOfALongChain) {
  const samples::Polygon polygon = samples::waves(20000);
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
    boxes.any(ear, 0, [&](std::size_t) {
      ++looked;
      return false;
    });
  }
  EXPECT_GT(triangles, 10000u);
  EXPECT_LT(looked, 8 * triangles);
}

}  // namespace
}  // namespace halfspace::io
