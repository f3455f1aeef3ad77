#include "halfspace/fast/self_intersections.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "boolean/shells.hpp"
#include "halfspace/fast/resolve.hpp"

namespace halfspace::fast {
namespace {

TEST(SelfIntersections, SurfacesThatCrossThemselvesAreFound) {
  std::uint64_t state = 5;
  for (int i = 0; i < 20; ++i) {
    const Cubes cubes = lattice::random_cubes(1 + i % 3, state);
    const Solid solid = to_solid(lattice::surface(cubes));
    EXPECT_TRUE(self_intersections(solid).empty());
    EXPECT_TRUE(self_intersections(merge_faces(solid, Merge::kPlane)).empty());
  }
  // One block within another, beside it, through it, and flush with it.
  const auto found = [](const Cubes& a, const Cubes& b) {
    return self_intersections(both_surfaces(a, b));
  };
  EXPECT_TRUE(found(block(0, 6, 6), block(1, 4, 4)).empty());
  EXPECT_TRUE(found(block(0, 2, 2), block(4, 6, 6)).empty());
  const auto through = found(block(0, 4, 4), block(1, 3, 7));
  ASSERT_EQ(through.size(), 4u);
  for (const SelfIntersection& crossing : through)
    EXPECT_FALSE(crossing.in_plane);
  const auto flush = found(block(0, 4, 4), block(1, 3, 4));
  // The sides of the small one leave the common plane between the two.
  ASSERT_EQ(flush.size(), 5u);
  EXPECT_EQ(std::count_if(flush.begin(), flush.end(),
                          [](const SelfIntersection& c) { return c.in_plane; }),
            1);
  EXPECT_EQ(found(block(0, 4, 4), block(0, 4, 4)).size(), 6u);
}

}  // namespace
}  // namespace halfspace::fast
