// Edges that are not used equally often in each direction, against a count of
// every pair of points.

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {
namespace {

using Triangles = std::vector<std::vector<VertexId>>;

Scene scene_of(std::vector<GridPoint> vertices, const Triangles& triangles) {
  SceneData data;
  data.vertices = std::move(vertices);
  for (const std::vector<VertexId>& triangle : triangles) {
    data.corners.insert(data.corners.end(), triangle.begin(), triangle.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({});
  }
  const Result<Scene> scene = make_scene(std::move(data));
  EXPECT_TRUE(scene) << scene.error().message;
  return *scene;
}

/// How much oftener each edge is used one way, of those where it is.
std::map<std::pair<GridPoint, GridPoint>, std::int64_t> excesses(
    const Scene& scene) {
  std::map<std::pair<GridPoint, GridPoint>, std::int64_t> uses;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const GridPoint& from = scene.point(corners[i]);
      const GridPoint& to = scene.point(corners[(i + 1) % corners.size()]);
      ++uses[{from, to}];
      --uses[{to, from}];
    }
  }
  std::erase_if(uses, [](const auto& use) { return use.second <= 0; });
  return uses;
}

/// Whether the bad edges are those that a map counts, in order.
void expect_counted(const Scene& scene) {
  const auto expected = excesses(scene);
  const std::vector<BadEdge> bad = bad_edges(scene);
  ASSERT_EQ(bad.size(), expected.size());
  for (const BadEdge& edge : bad) {
    const auto found = expected.find({edge.from, edge.to});
    ASSERT_NE(found, expected.end());
    ASSERT_EQ(edge.excess, found->second);
  }
  const auto ends = [](const BadEdge& edge) {
    return std::minmax(edge.from, edge.to);
  };
  for (std::size_t k = 1; k < bad.size(); ++k) {
    ASSERT_LT(ends(bad[k - 1]), ends(bad[k]));
  }
  ASSERT_EQ(make_solid(scene).has_value(), bad.empty());
}

TEST(BadEdges, AreThoseOfEveryTwoTrianglesOnSixPoints) {
  const std::vector<GridPoint> vertices = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0},
                                           {0, 0, 9}, {5, 5, 5}, {1, 7, 3}};
  Triangles all;
  for (VertexId u = 0; u < 6; ++u) {
    for (VertexId v = 0; v < 6; ++v) {
      for (VertexId w = 0; w < 6; ++w) {
        if (u != v && v != w && w != u) all.push_back({u, v, w});
      }
    }
  }
  for (const auto& first : all) {
    for (const auto& second : all) {
      if (second[0] > second[1] || second[0] > second[2]) continue;
      expect_counted(scene_of(vertices, {first, second}));
      ASSERT_FALSE(HasFailure());
    }
  }
}

TEST(BadEdges, AreThoseOfMixturesOfTrianglesOnFivePoints) {
  // Two of the points are there twice, as vertices of their own.
  const std::vector<GridPoint> vertices = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0},
                                           {0, 0, 9}, {5, 5, 5}, {0, 0, 0},
                                           {0, 9, 0}};
  std::mt19937 random(3);
  int closed = 0, by_point = 0;
  for (int i = 0; i < 5000; ++i) {
    Triangles triangles;
    const auto add = [&](VertexId u, VertexId v, VertexId w) {
      const auto at = [&](VertexId vertex) {
        return vertices[std::size_t(vertex)];
      };
      if (at(u) == at(v) || at(v) == at(w) || at(w) == at(u)) return;
      triangles.push_back({u, v, w});
    };
    const auto any = [&] { return static_cast<VertexId>(random() % 7); };
    // Tetrahedra, which are closed, some with a triangle left out or turned.
    for (std::size_t count = random() % 3; count > 0; --count) {
      const VertexId a = any(), b = any(), c = any(), d = any();
      add(a, b, c);
      add(b, a, d);
      add(c, b, d);
      add(a, c, d);
    }
    // One that is loose, first or last.
    if (!triangles.empty() && random() % 3 == 0) {
      add(any(), any(), any());
      if (random() % 2 == 0) std::swap(triangles.front(), triangles.back());
    }
    // The same point by another vertex.
    for (auto& triangle : triangles) {
      for (VertexId& v : triangle) {
        if (random() % 8 == 0) v = v == 0 ? 5 : v == 2 ? 6 : v;
      }
    }
    if (!triangles.empty() && random() % 2 == 0) {
      auto& triangle = triangles[random() % triangles.size()];
      if (random() % 2 == 0)
        std::swap(triangle[0], triangle[2]);
      else
        triangle = triangles.back();
    }
    const Scene scene = scene_of(vertices, triangles);
    expect_counted(scene);
    ASSERT_FALSE(HasFailure());
    const bool is_closed = bad_edges(scene).empty();
    closed += is_closed ? 1 : 0;
    bool has_copy = false;
    for (const auto& triangle : triangles) {
      for (const VertexId v : triangle) has_copy = has_copy || v > 4;
    }
    by_point += is_closed && has_copy ? 1 : 0;
  }
  EXPECT_GT(closed, 800);
  EXPECT_GT(by_point, 250);
}

TEST(MakeSolid, NamesTheFirstBadEdgeAndHowManyThereAre) {
  const std::vector<GridPoint> vertices = {
      {0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, -9}};
  const Result<GridSolid> open =
      make_solid(scene_of(vertices, {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}}));
  ASSERT_FALSE(open);
  EXPECT_EQ(open.error().code, ErrorCode::kOpen);
  EXPECT_EQ(open.error().index, 3);
  EXPECT_EQ(open.error().message,
            "the surface is not closed or not consistently oriented: 3 bad "
            "edges, the first from (0, 0, 0) to (0, 0, -9) (in grid steps)");
  const Triangles closed = {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}};
  const Result<GridSolid> solid = make_solid(scene_of(vertices, closed));
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->scene(), scene_of(vertices, closed));
}

}  // namespace
}  // namespace halfspace
