#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "box/box.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/render.hpp"
#include "tree/node_boxes.hpp"
#include "tree/triangles.hpp"

namespace halfspace::fast {
namespace {

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
