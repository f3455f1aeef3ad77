#include <gtest/gtest.h>

#include "booleans/contestant.hpp"

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

TEST(Booleans, AFaceSharedByAllIsOneFace) {
  const BooleanCase task = shared_face(20);
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

}  // namespace
}  // namespace halfspace::bench
