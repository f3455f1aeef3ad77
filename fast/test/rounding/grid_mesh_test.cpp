#include "rounding/grid_mesh.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

#include "rounding/grid_predicates.hpp"

namespace halfspace::fast {
namespace {

/// The surface of a block of unit cubes, each square in two triangles.
GridMesh block(std::int64_t size) {
  GridMesh mesh;
  std::map<GridPoint, std::int32_t> ids;
  const auto id = [&](const GridPoint& p) {
    const auto [at, is_new] =
        ids.try_emplace(p, static_cast<std::int32_t>(mesh.points.size()));
    if (is_new) mesh.points.push_back(p);
    return at->second;
  };
  const auto square = [&](const GridPoint& p, const GridPoint& q,
                          const GridPoint& r, const GridPoint& s) {
    mesh.triangles.push_back({{id(p), id(q), id(r)}, 0});
    mesh.triangles.push_back({{id(p), id(r), id(s)}, 0});
  };
  for (std::int64_t i = 0; i < size; ++i) {
    for (std::int64_t j = 0; j < size; ++j) {
      const std::int64_t n = size, k = i + 1, l = j + 1;
      square({i, j, n}, {k, j, n}, {k, l, n}, {i, l, n});
      square({i, j, 0}, {i, l, 0}, {k, l, 0}, {k, j, 0});
      square({n, i, j}, {n, k, j}, {n, k, l}, {n, i, l});
      square({0, i, j}, {0, i, l}, {0, k, l}, {0, k, j});
      square({i, n, j}, {i, n, l}, {k, n, l}, {k, n, j});
      square({i, 0, j}, {k, 0, j}, {k, 0, l}, {i, 0, l});
    }
  }
  mesh.moved.resize(mesh.points.size());
  return mesh;
}

bool edges_cancel(const GridMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> sum;
  for (const GridTriangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = t.corners[i], to = t.corners[(i + 1) % 3];
      sum[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (const auto& [ends, value] : sum) {
    if (value != 0) return false;
  }
  return true;
}

double volume(const GridMesh& mesh) {
  double sum = 0;
  for (const GridTriangle& t : mesh.triangles) {
    const GridPoint &a = mesh.at(t.corners[0]), &b = mesh.at(t.corners[1]),
                    &c = mesh.at(t.corners[2]);
    sum += static_cast<double>(a.x * (b.y * c.z - b.z * c.y) +
                               a.y * (b.z * c.x - b.x * c.z) +
                               a.z * (b.x * c.y - b.y * c.x));
  }
  return sum / 6;
}

TEST(FastGridMesh, WhatMovedAnyhowIsClosedAndHasAreas) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    GridMesh mesh = block(3);
    ASSERT_TRUE(edges_cancel(mesh));
    // To a coarser grid, mostly onto others and into lines.
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
      if (random() % 3 != 0) continue;
      GridPoint& at = mesh.points[p];
      at = {2 * (at.x / 2), 2 * (at.y / 2), at.z};
      mesh.moved[p] = 1;
    }
    const double before = volume(mesh);
    const Collapse collapse = clean(mesh);
    EXPECT_GT(collapse.points, 0u);
    EXPECT_TRUE(edges_cancel(mesh));
    // What went has no volume.
    EXPECT_EQ(volume(mesh), before);
    for (const GridTriangle& t : mesh.triangles) {
      ASSERT_FALSE(on_one_line(mesh.at(t.corners[0]), mesh.at(t.corners[1]),
                               mesh.at(t.corners[2])));
    }
    std::map<std::array<GridPoint, 3>, int> places;
    drop_unused_points(mesh);
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
      for (std::size_t q = 0; q < p; ++q)
        ASSERT_NE(mesh.points[p], mesh.points[q]);
    }
  }
}

TEST(FastGridMesh, ASlabThatIsFlattenedIsGone) {
  GridMesh mesh = block(2);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    mesh.points[p].z = 0;
    mesh.moved[p] = 1;
  }
  clean(mesh);
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(FastGridMesh, AVertexThatComesIntoAnEdgeCutsTheTriangleThere) {
  // A tetrahedron, with a vertex near the middle of one of its edges.
  GridMesh mesh;
  mesh.points = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 8}, {4, 1, 0}};
  mesh.moved = {0, 0, 0, 0, 1};
  mesh.triangles = {{{0, 2, 4}, 0}, {{4, 2, 1}, 0}, {{0, 4, 1}, 0},
                    {{0, 1, 3}, 1}, {{0, 3, 2}, 2}, {{1, 2, 3}, 3}};
  ASSERT_TRUE(edges_cancel(mesh));
  mesh.points[4].y = 0;
  const Collapse collapse = clean(mesh);
  EXPECT_EQ(collapse.triangles, 1u);
  EXPECT_EQ(mesh.triangles.size(), 6u);
  EXPECT_TRUE(edges_cancel(mesh));
}

}  // namespace
}  // namespace halfspace::fast
