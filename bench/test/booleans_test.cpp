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

}  // namespace
}  // namespace halfspace::bench
