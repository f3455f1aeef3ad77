#include "halfspace/fast/to_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "halfspace/fast/boolean.hpp"

namespace halfspace::fast {
namespace {

constexpr std::int64_t kFar = std::int64_t{1} << 24;

/// A tetrahedron, one of whose faces is half a square of the grid large and
/// `kFar` long.
Solid sliver(Unit unit) {
  SceneData data;
  data.unit = unit;
  data.vertices = {{0, 0, 0}, {kFar, 1, 0}, {kFar - 1, 1, 0}, {0, 0, -100}};
  data.corners = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
  data.first_corner = {0, 3, 6, 9, 12};
  data.colors.resize(4);
  return to_solid(*make_solid(*make_scene(std::move(data))));
}

TEST(Export, WhatDoublesHoldIsNotTurnedOver) {
  const ExportedMesh mesh = to_mesh(sliver({2, -3}));
  EXPECT_EQ(mesh.moved, 0u);
  EXPECT_TRUE(mesh.flipped.empty());
  // With thousandths all vertices but the origin are rounded.
  const ExportedMesh decimal = to_mesh(sliver({10, -3}));
  EXPECT_EQ(decimal.moved, 3u);
  EXPECT_FALSE(decimal.flipped.empty());
}

TEST(Export, TellsWhatRoundingFlattened) {
  // A box of two cubes far up, and what of it is between two planes that are
  // 2^-48 and 2^-47 apart there.
  SceneData data;
  for (const std::int64_t x : {1, 2}) {
    for (const std::int64_t y : {0, 1}) {
      for (const std::int64_t z : {kFar - 1, kFar + 1})
        data.vertices.push_back({x, y, z});
    }
  }
  data.corners = {0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1,
                  2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3};
  data.first_corner = {0, 4, 8, 12, 16, 20, 24};
  data.colors.resize(6);
  const Solid box = to_solid(*make_solid(*make_scene(std::move(data))));
  const auto below = [&](std::int64_t run) {
    return half_space({GridPoint{0, 0, kFar}, GridPoint{run, 0, kFar + 1},
                       GridPoint{0, 1, kFar}},
                      box);
  };
  const Solid slab = boolean(
      BooleanOp::kDifference,
      boolean(BooleanOp::kIntersection, box, below(kFar - 1)), below(kFar));
  const ExportedMesh mesh = to_mesh(slab);
  EXPECT_EQ(mesh.faces.size(), 6u);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_GE(mesh.moved, 4u);
  EXPECT_LE(mesh.max_move, 0x1p-28);
  // The four sides are lines now; what is above and below is not.
  EXPECT_EQ(mesh.flipped.size(), 4u);
  for (std::size_t p = 0; p < mesh.faces.size(); ++p) {
    std::vector<std::array<double, 2>> shadow;  // on the xy plane
    for (std::size_t c = mesh.first_corner[p]; c < mesh.first_corner[p + 1];
         ++c) {
      const auto& v = mesh.vertices[static_cast<std::size_t>(mesh.corners[c])];
      shadow.push_back({v[0], v[1]});
    }
    std::sort(shadow.begin(), shadow.end());
    const bool is_side =
        std::unique(shadow.begin(), shadow.end()) - shadow.begin() == 2;
    EXPECT_EQ(std::count(mesh.flipped.begin(), mesh.flipped.end(),
                         static_cast<std::int32_t>(p)),
              is_side ? 1 : 0);
  }
}

}  // namespace
}  // namespace halfspace::fast
