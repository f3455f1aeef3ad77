#include "halfspace/fast/build.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "scenes.hpp"
#include "tree/node_boxes.hpp"

namespace halfspace::fast {
namespace {

/// `count` triangles that cross each other, within 100 of the origin.
Scene crossing_triangles(int count) {
  std::mt19937_64 random(7);
  const auto coordinate = [&random] {
    return static_cast<std::int64_t>(random() % 201) - 100;
  };
  SceneData data;
  while (data.colors.size() < static_cast<std::size_t>(count)) {
    const GridPoint p = {coordinate(), coordinate(), coordinate()};
    // Corners on no line: they differ in x and in y in turn.
    add_polygon(
        data,
        {p, {p.x + 60, p.y, coordinate()}, {p.x, p.y + 60, coordinate()}});
  }
  return made(std::move(data));
}

Camera camera_at(std::int64_t eye_z) {
  CameraData data;
  data.eye = {30 * 256, -20 * 256, eye_z * 256};
  data.s0 = {-100 * 256, -100 * 256, 0};
  data.sx = {4 * 256, 0, 0};
  data.sy = {0, 4 * 256, 0};
  data.width_px = 64;
  data.height_px = 64;
  return *make_camera(data, 26);
}

TEST(Insert, KeepsTheBoxes) {
  const Scene scene = crossing_triangles(80);
  BspTree tree;
  for (PolygonId p = 0; p < 80; ++p) {
    insert(tree, scene, p);
    ASSERT_EQ(tree.boxes.size(), tree.nodes.size());
  }
  EXPECT_GT(tree.fragments.size(), 160u);
  // Uncut, all vertices are exact: the root's box is that of all vertices.
  BspTree whole = tree;
  add_boxes(whole, scene);
  EXPECT_EQ(tree.boxes[0], whole.boxes[0]);
  // A box that is too small would hide something from somewhere.
  BspTree bare = tree;
  bare.boxes.clear();
  for (const std::int64_t z : {-400, -90, 20, 70, 500}) {
    const Camera camera = camera_at(z);
    const Rendering expected = render(scene, bare, camera, {});
    EXPECT_EQ(render(scene, tree, camera, {}).items, expected.items);
    EXPECT_GT(expected.pixels_painted, 100u);
  }
}

TEST(Insert, LeavesATreeWithoutBoxesWithoutThem) {
  const Scene scene = crossing_triangles(10);
  BspTree tree;
  for (PolygonId p = 0; p < 9; ++p) insert(tree, scene, p);
  tree.boxes.clear();
  insert(tree, scene, 9);
  EXPECT_TRUE(tree.boxes.empty());
}

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

TEST(Insert, CountsItsDecisions) {
  SceneData data;
  data.vertices = {{0, 0, 0}, {0, 9, 0}, {0, 0, 9}, {5, 3, 1}};
  data.corners = {0, 1, 2, 0, 1, 3};
  data.first_corner = {0, 3, 6};
  data.colors = {{}, {}};
  const Result<Scene> scene = make_scene(std::move(data));
  ASSERT_TRUE(scene.has_value());
  BspTree tree;
  FilterStats stats;
  insert(tree, *scene, 0, stats);
  EXPECT_EQ(stats.filtered + stats.exact, 0u);
  // Two corners are on the first polygon's plane, one is off it.
  insert(tree, *scene, 1, stats);
  EXPECT_EQ(stats.filtered, 1u);
  EXPECT_EQ(stats.exact, 2u);
  EXPECT_EQ(stats.zero, 2u);
}

}  // namespace
}  // namespace halfspace::fast
