#include "halfspace/region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "halfspace/moving.hpp"

namespace halfspace {
namespace {

ObjectRegion hull(std::vector<GridPoint> points) {
  const Result<ObjectRegion> region = hull_region(std::move(points));
  EXPECT_TRUE(region);
  return *region;
}

/// The corner of a cube of size 4, cut off by x + y + z = 4.
ObjectRegion corner() {
  return hull({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}});
}

TEST(Region, AHullHasItsBoxAndItsSlantedFaces) {
  const ObjectRegion region = corner();
  EXPECT_EQ(region.low, (GridPoint{0, 0, 0}));
  EXPECT_EQ(region.high, (GridPoint{4, 4, 4}));
  ASSERT_EQ(region.slanted.size(), 1u);
  EXPECT_GT(side_of(region.slanted[0], {0, 0, 0}), 0);
  EXPECT_GT(side_of(region.slanted[0], {2, 1, 0}), 0);
  EXPECT_EQ(side_of(region.slanted[0], {2, 1, 1}), 0);
  EXPECT_LT(side_of(region.slanted[0], {2, 2, 1}), 0);
}

TEST(Region, PointsInsideOfAHullAndInItsFacesMakeNoFace) {
  const ObjectRegion region = hull({{0, 0, 0},
                                    {1, 1, 1},
                                    {4, 0, 0},
                                    {0, 4, 0},
                                    {2, 2, 0},
                                    {1, 1, 2},
                                    {0, 0, 4},
                                    {4, 0, 0}});
  EXPECT_EQ(region.slanted.size(), 1u);
}

TEST(Region, AHullAtTheEndsOfTheGridIsExact) {
  const std::int64_t far = (std::int64_t{1} << 53) - 1;
  const ObjectRegion region = hull({{-far, -far, -far},
                                    {far, -far, -far},
                                    {-far, far, -far},
                                    {-far, -far, far}});
  ASSERT_EQ(region.slanted.size(), 1u);
  EXPECT_EQ(side_of(region.slanted[0], {far, -far, -far}), 0);
  EXPECT_GT(side_of(region.slanted[0], {far - 1, -far, -far}), 0);
  EXPECT_LT(side_of(region.slanted[0], {far, -far + 1, -far}), 0);
}

TEST(Region, FewPointsManyPointsAndPlanesAreNoHull) {
  EXPECT_FALSE(hull_region({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_FALSE(hull_region({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 7, 0}}));
  std::vector<GridPoint> many;
  for (std::int64_t k = 0; k <= 30; ++k) many.push_back({k, k * k, k * k * k});
  EXPECT_FALSE(hull_region(many));
  many.pop_back();
  EXPECT_TRUE(hull_region(many));
}

TEST(Region, HullsInOneBoxShareNoSpaceBesideAFace) {
  const ObjectRegion below = corner();
  const ObjectRegion above =
      hull({{4, 4, 4}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {4, 4, 0}});
  const ObjectRegion across =
      hull({{4, 4, 4}, {4, 0, 0}, {0, 4, 0}, {0, 0, 3}, {4, 4, 0}});
  EXPECT_FALSE(share_space(below, above));
  EXPECT_FALSE(share_space(above, below));
  EXPECT_TRUE(share_space(below, across));
  EXPECT_TRUE(share_space(across, below));
  EXPECT_TRUE(share_space(below, below));
  EXPECT_TRUE(share_space(below, ObjectRegion{{1, 1, 1}, {9, 9, 9}}));
  EXPECT_FALSE(share_space(below, ObjectRegion{{2, 1, 1}, {9, 9, 9}}));
  EXPECT_FALSE(share_space(ObjectRegion{{2, 1, 1}, {9, 9, 9}}, below));
}

/// A tetrahedron with an edge along x at height `z`, below it where `sign` is
/// negative, and one with an edge along y: only planes along both part them.
TEST(Region, HullsArePartedByAPlaneAlongAnEdgeOfEach) {
  const auto lower = [](std::int64_t z) {
    return hull({{-9, 0, z}, {9, 0, z}, {0, -4, z - 9}, {0, 4, z - 9}});
  };
  const ObjectRegion upper =
      hull({{0, -9, 0}, {0, 9, 0}, {-4, 0, 9}, {4, 0, 9}});
  EXPECT_FALSE(share_space(lower(0), upper));
  EXPECT_FALSE(share_space(upper, lower(0)));
  EXPECT_TRUE(share_space(lower(1), upper));
  EXPECT_TRUE(share_space(upper, lower(1)));
  // Leaning, so that no plane across an axis parts them.
  const auto lean = [](ObjectRegion region, std::int64_t up) {
    std::vector<GridPoint> points = region.hull;
    for (GridPoint& p : points) p.z += p.x + 2 * p.y + up;
    return hull(points);
  };
  EXPECT_FALSE(share_space(lean(lower(0), 0), lean(upper, 0)));
  EXPECT_TRUE(share_space(lean(lower(0), 1), lean(upper, 0)));
}

TEST(Region, AnAssemblyTakesNoHullWithFacesOfItsOwn) {
  SceneData data;
  data.unit = {2, 0};
  data.grid_bits = 26;
  Model world;
  world.scene = *make_scene(data);
  Model object = world;
  world.objects.push_back({1, corner()});
  EXPECT_TRUE(make_assembly({world, object}));
  world.objects[0].region.slanted.clear();
  EXPECT_FALSE(make_assembly({world, object}));
  world.objects[0].region = corner();
  world.objects[0].region.high.x = 5;
  EXPECT_FALSE(make_assembly({world, object}));
}

}  // namespace
}  // namespace halfspace
