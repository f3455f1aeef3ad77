#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "booleans/contestant.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/to_mesh.hpp"

namespace halfspace::bench {
namespace {

TEST(Booleans, SurfacesAreTheLeastOnes) {
  for (const BooleanCase& task : {menger(3), plate()}) {
    SCOPED_TRACE(task.name);
    ASSERT_NE(task.least, 0u);
    const auto in_turn = ours_in_turn().run(task);
    EXPECT_EQ(in_turn->triangles, task.least);
    EXPECT_TRUE(in_turn->closed);
    const auto at_once = ours_at_once().run(task);
    EXPECT_EQ(at_once->triangles, task.least);
    EXPECT_EQ(at_once->volume6, in_turn->volume6);
  }
  // 20^3 cubes of 1024 a side are left of a sponge of level 3.
  EXPECT_EQ(ours_in_turn().run(menger(3))->volume6, 6.0 * 8000 * 0x1p30);
}

/// How many triangles of all operands' union lie in the plane z = 0.
std::size_t triangles_on_ground(const BooleanCase& task) {
  std::vector<fast::Solid> solids;
  for (const Triangles& operand : task.operands) {
    const GridSolid solid = solid_of(operand);
    solids.push_back(solids.empty() ? fast::to_solid(solid)
                                    : fast::to_solid(solid, solids[0]));
  }
  const auto mesh =
      fast::to_mesh(fast::merge_faces(fast::boolean_all(task.operation, solids),
                                      fast::Merge::kPlane),
                    {.triangles = true});
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    bool is_low = true;
    for (std::size_t i = 3 * t; i < 3 * t + 3; ++i)
      is_low = is_low &&
               mesh.vertices[static_cast<std::size_t>(mesh.corners[i])][2] == 0;
    if (is_low) ++count;
  }
  return count;
}

TEST(Booleans, AFaceSharedByAllIsOneFace) {
  const BooleanCase task = shared_face(20);
  EXPECT_EQ(triangles_on_ground(task), 2u);
  const auto in_turn = ours_in_turn().run(task);
  const auto at_once = ours_at_once().run(task);
  EXPECT_TRUE(in_turn->closed);
  EXPECT_EQ(in_turn->triangles, at_once->triangles);
  EXPECT_EQ(in_turn->volume6, at_once->volume6);
  // More than any pyramid, less than the block that holds them all.
  EXPECT_GT(in_turn->volume6, 2.0 * 0x1p59);
  EXPECT_LT(in_turn->volume6, 6.0 * 0x1p60);
}

TEST(Booleans, SpheresTurnedHaveAllTrianglesCut) {
  const BooleanCase task = two_spheres(1000, 0.01);
  const auto outcome = ours_in_turn().run(task);
  EXPECT_TRUE(outcome->closed);
  EXPECT_GT(outcome->triangles, 4 * task.operands[0].corners.size());
}

TEST(Booleans, FloatsFillTheirGridAndWhatIsFlushStaysSo) {
  for (const int grid_bits : {26, 40, 54}) {
    SCOPED_TRACE(grid_bits);
    const BooleanCase task = in_floats(plate(), grid_bits, 7);
    for (const Triangles& operand : task.operands) {
      EXPECT_EQ(grid_bits_for(operand.points), grid_bits);
      for (const GridPoint& p : operand.points) {
        for (const std::int64_t x : {p.x, p.y, p.z}) {
          const auto at = static_cast<double>(x);
          EXPECT_EQ(double{static_cast<float>(at)}, at);
        }
      }
    }
    const auto outcome = ours_checked().run(task);
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->triangles, task.least);
    const auto at_once = ours_at_once_checked().run(task);
    ASSERT_TRUE(at_once);
    EXPECT_EQ(at_once->triangles, task.least);
  }
  EXPECT_NE(two_spheres(1000, 0, 1).operands[1].points[0].x,
            two_spheres(1000, 0, 2).operands[1].points[0].x);
}

TEST(Booleans, OfASphereWithItselfItOrNothingIsLeft) {
  const BooleanCase task = same_sphere(1000, BooleanOp::kUnion);
  const auto whole = ours_in_turn().run(task);
  const double volume6 = volume6_of(task.operands[0]);
  EXPECT_NEAR(whole->volume6, volume6, 1e-12 * volume6);
  EXPECT_TRUE(whole->closed);
  EXPECT_EQ(
      ours_in_turn().run(same_sphere(1000, BooleanOp::kDifference))->triangles,
      0u);
}

}  // namespace
}  // namespace halfspace::bench
