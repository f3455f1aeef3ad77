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
  std::size_t all = 0;
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
    ASSERT_EQ(split.scene.data().corners.size(),
              scene.data().corners.size() + expected);
    all += expected;
  }
  EXPECT_GT(all, 500u);  // or it would say little
}

}  // namespace
}  // namespace halfspace::csg
