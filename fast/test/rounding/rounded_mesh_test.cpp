#include "halfspace/fast/rounded_mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "halfspace/fast/boolean.hpp"
#include "shapes.hpp"

namespace halfspace::fast {
namespace {

using shapes::Motion;

/// Floats so far out are multiples of this.
constexpr double kFar = 0x1p39;
constexpr double kSpacing = 0x1p16;

/// Moves far out, where floats are far apart.
Motion far_out(Motion motion) {
  motion.shift = {kFar * 1.2, -kFar * 1.3, kFar * 1.4};
  return motion;
}

void expect_solid(const Solid& solid, const std::string& what) {
  for (const FileNumber number : {FileNumber::kFloat, FileNumber::kDouble}) {
    const auto mesh = rounded_mesh(solid, {.number = number});
    ASSERT_TRUE(mesh.has_value()) << what << ": " << mesh.error().message;
    EXPECT_EQ(shapes::fault_of(*mesh, number), "") << what;
    EXPECT_LE(mesh->max_move, 128 * mesh->spacing) << what;
  }
}

TEST(FastRounding, BoxesWithBarsCutOutStaySolidsOnCoarseGrids) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> at(-64, 64);
    const double s = kSpacing;
    Solid solid = shapes::box({-64 * s, -64 * s, -64 * s},
                              {64 * s, 64 * s, 64 * s}, far_out({}));
    for (int bar = 0; bar < 8; ++bar) {
      Motion motion = far_out(shapes::turned(random, at(random)));
      for (double& c : motion.shift) c += s * at(random);
      const Solid cut = shapes::box({-200 * s, -3 * s, -3 * s},
                                    {200 * s, 3 * s, 3 * s}, motion, &solid);
      solid = boolean(BooleanOp::kDifference, solid, cut);
    }
    expect_solid(solid, "bars " + std::to_string(seed));
  }
}

TEST(FastRounding, CubesTurnedALittleStaySolids) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> angle(-0.001, 0.001);
    const double s = 1024 * kSpacing;
    Solid solid = shapes::box({-s, -s, -s}, {s, s, s}, far_out({}));
    for (int cube = 0; cube < 3; ++cube) {
      const Solid other =
          shapes::box({-s, -s, -s}, {s, s, s},
                      far_out(shapes::turned(random, angle(random))), &solid);
      solid = boolean(BooleanOp::kUnion, solid, other);
    }
    expect_solid(solid, "cubes " + std::to_string(seed));
  }
}

TEST(FastRounding, NearlyCoincidentSpheresStaySolids) {
  for (const double steps : {1.0, 2.0, 4.0, 16.0}) {
    const double r = 512 * kSpacing;
    const Solid a = shapes::sphere(r, 8, 12, far_out({}));
    Motion motion = far_out(shapes::turned_about_each_axis(steps / 512));
    const Solid b = shapes::sphere(r, 8, 12, motion, &a);
    expect_solid(boolean(BooleanOp::kDifference, a, b),
                 "spheres " + std::to_string(steps));
    Motion shifted = far_out({});
    shifted.shift[0] += steps * kSpacing;
    const Solid c = shapes::sphere(r, 8, 12, shifted, &a);
    expect_solid(boolean(BooleanOp::kDifference, a, c),
                 "shifted " + std::to_string(steps));
  }
}

TEST(FastRounding, ASlabThinnerThanItsNumbersVanishes) {
  const double s = 64 * kSpacing;
  const Solid slab =
      shapes::box({0, 0, 0.1 * kSpacing}, {s, s, 0.2 * kSpacing}, far_out({}));
  const auto mesh = rounded_mesh(slab, {.number = FileNumber::kFloat});
  ASSERT_TRUE(mesh.has_value());
  EXPECT_TRUE(mesh->faces.empty());
  EXPECT_EQ(mesh->faces_lost, slab.faces.size());
  EXPECT_EQ(mesh->parts_before, 1u);
  EXPECT_EQ(mesh->parts_after, 0u);
  // Doubles have it.
  const auto fine = rounded_mesh(slab);
  ASSERT_TRUE(fine.has_value());
  EXPECT_EQ(fine->moved, 0u);
  EXPECT_EQ(fine->max_move, 0);
  EXPECT_EQ(fine->faces_lost, 0u);
}

TEST(FastRounding, VerticesThatAreNumbersOfTheFileStayAndFacesWithThem) {
  // Within the same binade, floats near 0 are finer than the grid of the file.
  const Solid a = shapes::box({1, 1, 1}, {0x1p40, 3, 5}, {});
  const auto mesh = rounded_mesh(a, {.number = FileNumber::kFloat});
  ASSERT_TRUE(mesh.has_value());
  EXPECT_EQ(mesh->moved, 0u);
  EXPECT_EQ(shapes::fault_of(*mesh, FileNumber::kFloat), "");
  EXPECT_EQ(mesh->vertices.size(), 8u);
}

TEST(FastRounding, AMoveBeyondTheBoundIsRefusedWithItsPlace) {
  const double s = 64 * kSpacing;
  const Solid box =
      shapes::box({0, 0, 0}, {s, s, 0.4 * kSpacing + s}, far_out({}));
  const auto refused =
      rounded_mesh(box, {.number = FileNumber::kFloat, .max_move = 100.0});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfRange);
  EXPECT_NE(refused.error().message.find("near"), std::string::npos);
  EXPECT_TRUE(
      rounded_mesh(box, {.number = FileNumber::kFloat, .max_move = kSpacing})
          .has_value());
}

TEST(FastRounding, TheMeshIsTheSameForAnyNumberOfThreads) {
  const double r = 512 * kSpacing;
  const Solid a = shapes::sphere(r, 8, 12, far_out({}));
  const Solid b = shapes::sphere(
      r, 8, 12, far_out(shapes::turned_about_each_axis(0.01)), &a);
  const Solid solid = boolean(BooleanOp::kDifference, a, b);
  const auto one = rounded_mesh(
      solid, {.number = FileNumber::kFloat, .triangles = true, .threads = 1});
  const auto four = rounded_mesh(
      solid, {.number = FileNumber::kFloat, .triangles = true, .threads = 4});
  ASSERT_TRUE(one.has_value() && four.has_value());
  EXPECT_EQ(one->vertices, four->vertices);
  EXPECT_EQ(one->corners, four->corners);
  EXPECT_EQ(one->faces, four->faces);
  EXPECT_GT(one->crossings, 0u);
}

TEST(FastRounding, NearlyCoincidentSheetsArePutApartAndNotCutUp) {
  const double r = 512 * kSpacing;
  std::size_t met = 0;
  for (const double angle : {0.1, 0.02}) {
    const Solid a = shapes::sphere(r, 12, 24, far_out({}));
    const Solid b = shapes::sphere(
        r, 12, 24, far_out(shapes::turned_about_each_axis(angle)), &a);
    const Solid solid = boolean(BooleanOp::kDifference, a, b);
    const auto mesh =
        rounded_mesh(solid, {.number = FileNumber::kFloat, .triangles = true});
    ASSERT_TRUE(mesh.has_value());
    EXPECT_EQ(shapes::fault_of(*mesh, FileNumber::kFloat), "");
    met += mesh->crossings;
    EXPECT_LE(mesh->rounds, 4u) << angle;
    EXPECT_LE(mesh->max_move, 12 * mesh->spacing) << angle;
  }
  EXPECT_GT(met, 20u);
}

TEST(FastRounding, WhatIsNoSolidAnyMoreIsFoundByTheTestItself) {
  const Solid solid = shapes::sphere(512 * kSpacing, 8, 12, far_out({}));
  auto mesh = rounded_mesh(solid, {.number = FileNumber::kFloat});
  ASSERT_TRUE(mesh.has_value());
  ASSERT_EQ(shapes::fault_of(*mesh, FileNumber::kFloat), "");
  RoundedMesh off = *mesh;
  off.vertices[20][0] += kSpacing / 2;
  EXPECT_NE(shapes::fault_of(off, FileNumber::kFloat), "");
  off = *mesh;
  off.vertices[20] = off.vertices[60];
  EXPECT_NE(shapes::fault_of(off, FileNumber::kFloat), "");
  off = *mesh;
  for (std::size_t k = 0; k < 3; ++k)
    off.vertices[20][k] = 2 * off.vertices[60][k] - off.vertices[61][k];
  EXPECT_NE(shapes::fault_of(off, FileNumber::kFloat), "");
}

}  // namespace
}  // namespace halfspace::fast
