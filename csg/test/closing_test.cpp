#include "halfspace/csg/closing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "halfspace/boolean.hpp"

namespace halfspace::csg {
namespace {

using Vector = std::array<std::int64_t, 3>;

Vector from_to(const GridPoint& p, const GridPoint& q) {
  return {q.x - p.x, q.y - p.y, q.z - p.z};
}

bool is_on_line(const GridPoint& r, const GridPoint& p, const GridPoint& q) {
  const Vector a = from_to(p, q), b = from_to(p, r);
  return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] &&
         a[0] * b[1] == a[1] * b[0];
}

/// How many ends of bad edges on its line lie within the edge, if it is bad.
std::size_t ends_within(const GridPoint& p, const GridPoint& q,
                        const std::vector<BadEdge>& bad) {
  if (std::none_of(bad.begin(), bad.end(), [&](const BadEdge& edge) {
        return std::minmax(edge.from, edge.to) == std::minmax(p, q);
      }))
    return 0;
  std::set<GridPoint> within;
  for (const BadEdge& edge : bad) {
    if (!is_on_line(edge.from, p, q) || !is_on_line(edge.to, p, q)) continue;
    for (const GridPoint& end : {edge.from, edge.to}) {
      if (std::min(p, q) < end && end < std::max(p, q)) within.insert(end);
    }
  }
  return within.size();
}

/// Triangles with corners on a lattice so small that many edges share a line.
Scene triangles(std::mt19937& random, int count) {
  SceneData data;
  constexpr int kSide = 4;
  for (int v = 0; v < kSide * kSide * 2; ++v)
    data.vertices.push_back({v % kSide, v / kSide % kSide, v / kSide / kSide});
  const auto points = static_cast<VertexId>(data.vertices.size());
  while (count > 0) {
    std::array<VertexId, 3> corners;
    for (VertexId& corner : corners)
      corner = static_cast<VertexId>(random() % static_cast<unsigned>(points));
    const auto at = [&](std::size_t i) {
      return data.vertices[static_cast<std::size_t>(corners[i])];
    };
    if (is_on_line(at(2), at(0), at(1)) || at(0) == at(1)) continue;
    data.corners.insert(data.corners.end(), corners.begin(), corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({1, 2, 3});
    --count;
  }
  return *make_scene(std::move(data));
}

TEST(Closing, AddsTheEndsThatLieWithinBadEdges) {
  std::mt19937 random(20261126);
  std::size_t all = 0, open_at_once = 0;
  for (int i = 0; i < 2000; ++i) {
    const Scene scene = triangles(random, 1 + i % 12);
    const std::vector<BadEdge> bad = bad_edges(scene);
    std::size_t expected = 0;
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const auto corners = scene.corners(static_cast<PolygonId>(p));
      for (std::size_t k = 0; k < corners.size(); ++k) {
        expected +=
            ends_within(scene.point(corners[k]),
                        scene.point(corners[(k + 1) % corners.size()]), bad);
      }
    }
    const ClosedScene split = split_on_lines(scene);
    ASSERT_EQ(split.added, expected) << "soup " << i;
    // By a look at some of the edges, at once.
    if (stays_open_on_lines(bad)) {
      ++open_at_once;
      ASSERT_TRUE(split.is_open) << "soup " << i;
    }
    ASSERT_EQ(split.scene.data().corners.size(),
              scene.data().corners.size() + expected);
    all += expected;
  }
  EXPECT_GT(all, 500u);  // or it would say little
  EXPECT_GT(open_at_once, 1000u);
}

TEST(Closing, IsNotSaidToStayOpenWhereLinesCancel) {
  // A cube of which the sides have corners that the top and bottom have not.
  std::mt19937 random(21);
  for (int i = 0; i < 200; ++i) {
    SceneData data;
    const auto corner = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      data.vertices.push_back({x, y, z});
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()) - 1);
    };
    const auto end = [&] {
      data.first_corner.push_back(
          static_cast<std::uint32_t>(data.corners.size()));
      data.colors.push_back({1, 2, 3});
    };
    const std::array<std::array<std::int64_t, 2>, 5> ring = {
        {{0, 0}, {60, 0}, {60, 60}, {0, 60}, {0, 0}}};
    for (const bool top : {false, true}) {
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& [x, y] = ring[top ? k : 3 - k];
        corner(x, y, top ? 60 : 0);
      }
      end();
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [x, y] = ring[k];
      const auto [u, v] = ring[k + 1];
      // In strips, of edges of the same line one after another.
      const auto strips = static_cast<std::int64_t>(1 + random() % 5);
      for (std::int64_t s = 0; s < strips; ++s) {
        const auto at = [&](std::int64_t part, std::int64_t z) {
          corner(x + (u - x) * part / strips, y + (v - y) * part / strips, z);
        };
        at(s, 0);
        at(s + 1, 0);
        at(s + 1, 60);
        at(s, 60);
        end();
      }
    }
    const Scene scene = *make_scene(std::move(data));
    ASSERT_FALSE(stays_open_on_lines(bad_edges(scene)));
    ASSERT_FALSE(closed_on_lines(scene).is_open);
  }
}

}  // namespace
}  // namespace halfspace::csg
