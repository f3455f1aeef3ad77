#include "halfspace/fast/build.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "halfspace/fast/display_tree.hpp"
#include "tree/triangles.hpp"

namespace halfspace::fast {
namespace {

TEST(Build, TellsHowFarItIs) {
  const Scene scene = crossing_triangles(300);
  std::vector<double> told;
  FilterStats stats;
  const BspTree tree = build(scene, {}, stats, [&](double share) {
    told.push_back(share);
    return true;
  });
  ASSERT_GT(told.size(), 10u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.front(), 0);
  EXPECT_GT(told.back(), 0.9);
  EXPECT_LE(told.back(), 1);
  EXPECT_EQ(name_of(tree), name_of(build(scene, {})));
}

TEST(Build, StopsWhenToldTo) {
  const Scene scene = crossing_triangles(300);
  FilterStats stats;
  int calls = 0;
  const auto third = [&](double) { return ++calls < 3; };
  EXPECT_TRUE(build(scene, {}, stats, third).nodes.empty());
  EXPECT_EQ(calls, 3);
}

/// Where all polygons are candidates, one root is choosing for a long time.
TEST(Build, StopsWithinTheChoiceOfARoot) {
  const Scene scene = crossing_triangles(3000);
  FilterStats stats;
  BuildOptions options;
  options.rule = RootRule::kFewestCuts;
  const auto at_once = [](double) { return false; };
  EXPECT_TRUE(build(scene, options, stats, at_once).nodes.empty());
  EXPECT_LT(stats.filtered + stats.exact, 3 * 3000u * 3000u / 2);
}

TEST(TreeBytes, AreThoseOfTheArrays) {
  const BspTree tree = build(crossing_triangles(50), {});
  const TreeBytes bytes = bytes_by_array(tree);
  EXPECT_EQ(bytes.total(), bytes_of(tree));
  EXPECT_GE(bytes.nodes, tree.nodes.size() * sizeof(Node));
  EXPECT_GE(bytes.boxes, tree.boxes.size() * sizeof(Box));
  EXPECT_GE(bytes.fragments, tree.fragments.size() * sizeof(TreeFragment));
  EXPECT_GE(bytes.corners, tree.corners.size() * sizeof(Corner));
  EXPECT_GE(bytes.cut_vertices, tree.cut_vertices.size() * sizeof(Vertex));
  EXPECT_EQ(bytes.free_planes, 0u);
  EXPECT_EQ(bytes.blocks, 0u);
}

}  // namespace
}  // namespace halfspace::fast
