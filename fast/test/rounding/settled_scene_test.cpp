#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {
namespace {

/// A closed surface of triangles: a ball whose radius goes up and down, so that
/// sheets come near to each other where it is rounded to few steps.
SceneData hedgehog(std::mt19937_64& random, double radius) {
  constexpr int kStacks = 9, kSlices = 14;
  constexpr double kPi = 3.14159265358979323846;
  std::uniform_real_distribution<double> share(0.02, 1);
  SceneData data;
  data.grid_bits = 26;
  const auto add = [&](double polar, double azimuth) {
    const double r = radius * share(random);
    data.vertices.push_back(
        {std::llround(r * std::sin(polar) * std::cos(azimuth)),
         std::llround(r * std::sin(polar) * std::sin(azimuth)),
         std::llround(r * std::cos(polar))});
  };
  add(0, 0);
  for (int i = 1; i < kStacks; ++i) {
    for (int j = 0; j < kSlices; ++j)
      add(kPi * i / kStacks, 2 * kPi * j / kSlices);
  }
  add(kPi, 0);
  const int last = static_cast<int>(data.vertices.size()) - 1;
  const auto at = [&](int i, int j) {
    return i == 0         ? 0
           : i == kStacks ? last
                          : 1 + (i - 1) * kSlices + j % kSlices;
  };
  const auto triangle = [&](int a, int b, int c) {
    const auto& v = data.vertices;
    const auto same = [&](int p, int q) {
      return v[static_cast<std::size_t>(p)] == v[static_cast<std::size_t>(q)];
    };
    if (same(a, b) || same(b, c) || same(c, a)) return;
    data.corners.insert(data.corners.end(), {a, b, c});
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
  };
  for (int i = 0; i < kStacks; ++i) {
    for (int j = 0; j < kSlices; ++j) {
      triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  data.colors.resize(data.first_corner.size() - 1);
  return data;
}

bool is_fine(const Scene& scene) {
  const Result<GridSolid> solid = make_solid(scene);
  return solid && check_operand(to_solid(*solid)).has_value();
}

TEST(FastSettledScene, WhatRoundingMadeCrossIsASolidNearby) {
  int crossing = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937_64 random(seed);
    const Result<Scene> scene = make_scene(hedgehog(random, 12 + seed));
    if (!scene || !make_solid(*scene)) continue;
    const bool was_fine = is_fine(*scene);
    const Result<SettledScene> settled = settled_scene(*scene);
    ASSERT_TRUE(settled.has_value()) << settled.error().message;
    EXPECT_TRUE(is_fine(settled->scene)) << seed;
    EXPECT_EQ(settled->scene.unit(), scene->unit());
    EXPECT_EQ(settled->scene.grid_bits(), scene->grid_bits());
    ASSERT_EQ(settled->polygons.size(), settled->scene.polygon_count());
    for (const PolygonId p : settled->polygons) {
      EXPECT_GE(p, 0);
      EXPECT_LT(static_cast<std::size_t>(p), scene->polygon_count());
    }
    if (was_fine) {
      EXPECT_EQ(settled->max_move, 0) << seed;
    } else {
      EXPECT_LE(settled->max_move, 16) << seed;
      ++crossing;
    }
  }
  EXPECT_GE(crossing, 8);
}

}  // namespace
}  // namespace halfspace::fast
