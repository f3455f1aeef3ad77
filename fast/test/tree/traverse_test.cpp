#include <gtest/gtest.h>
#include <pthread.h>

#include <functional>
#include <utility>

#include "cases.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/image/depth_sort.hpp"
#include "halfspace/fast/render.hpp"
#include "scenes.hpp"
#include "tree/node_boxes.hpp"
#include "tree/triangles.hpp"

namespace halfspace::fast {
namespace {

/// Runs `body` in a thread with a stack of 256 KiB.
void with_small_stack(std::function<void()> body) {
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 256 * 1024), 0);
  pthread_t thread;
  const auto run = [](void* argument) -> void* {
    (*static_cast<std::function<void()>*>(argument))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, run, &body), 0);
  ASSERT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&attributes);
}

/// `count` triangles one behind the other, z = 0, 1, 2, ...
Scene stack_of_triangles(std::int32_t count) {
  SceneData data;
  for (std::int32_t k = 0; k < count; ++k) {
    add_polygon(data, {{-99, -99, k}, {99, -99, k}, {0, 99, k}},
                {static_cast<std::uint8_t>(k), 0, 0});
  }
  return made(std::move(data));
}

/// A camera that looks along the stack, from its first or its last triangle.
Camera camera_along(std::int64_t eye_z, std::int64_t image_z) {
  CameraData data;
  data.eye = {0, 0, eye_z * 256};
  data.s0 = {-100 * 256, -100 * 256, image_z * 256};
  data.sx = {10 * 256, 0, 0};
  data.sy = {0, 10 * 256, 0};
  data.width_px = 20;
  data.height_px = 20;
  return *make_camera(data, 26);
}

/// The tree that is one chain: node k has node k + 1 as its positive child.
BspTree chain(const Scene& scene) {
  BspTree tree;
  const auto count = static_cast<std::int32_t>(scene.polygon_count());
  for (std::int32_t k = 0; k < count; ++k) {
    Node node;
    node.splitter = k;
    node.positive = k + 1 < count ? k + 1 : kNoNode;
    node.first_fragment = k;
    node.plane = plane_of(scene, k);
    tree.nodes.push_back(node);
    tree.fragments.push_back(
        {k, static_cast<std::uint32_t>(3 * k), 3, 0, kNoFragment});
    for (std::int32_t c = 0; c < 3; ++c) tree.corners.push_back({c, 3 * k + c});
  }
  return tree;
}

TEST(Deep, AChainOfAMillionNodesNeedsLittleStack) {
  constexpr auto kCount = static_cast<std::int32_t>(cases(1'000'000));
  with_small_stack([] {
    const Scene scene = stack_of_triangles(kCount);
    BspTree tree = chain(scene);
    EXPECT_EQ(stats(tree).height, std::size_t{kCount});
    EXPECT_EQ(name_of(tree).size(), std::size_t{kCount});
    for (const bool boxes : {false, true}) {
      if (boxes) add_boxes(tree, scene);
      const Rendering near_end =
          render(scene, tree, camera_along(-500, -100), {});
      EXPECT_EQ(near_end.items.at(10, 10), 0);
      const Rendering far_end =
          render(scene, tree, camera_along(kCount + 500, kCount + 100), {});
      EXPECT_EQ(far_end.items.at(10, 10), kCount - 1);
    }
    insert(tree, scene, 0);  // once more, into its own node
    EXPECT_EQ(tree.nodes.size(), std::size_t{kCount});
  });
}

TEST(Deep, AChainIsBuiltWithLittleStack) {
  constexpr std::int32_t kCount = 4'000;
  with_small_stack([] {
    const Scene scene = stack_of_triangles(kCount);
    BuildOptions options;
    options.rule = RootRule::kFirst;
    const BspTree built = build(scene, options);
    EXPECT_EQ(stats(built).height, std::size_t{kCount});
    BspTree grown;
    for (PolygonId p = 0; p < kCount; ++p) insert(grown, scene, p);
    EXPECT_EQ(name_of(grown), name_of(built));
  });
}

/// What arises by cutting is known by how large the scene is, not the grid.
TEST(DepthSorts, CutAsLittleOnAFineGrid) {
  const Scene scene = crossing_triangles(20);
  SceneData data = scene.data();
  data.grid_bits = 54;
  const Scene fine = made(std::move(data));
  const Camera camera = camera_along(300, 200);
  const DepthSort coarse_sort = depth_sort(scene, camera);
  const DepthSort fine_sort = depth_sort(fine, *make_camera(camera.data(), 54));
  EXPECT_GT(coarse_sort.cuts, 10u);
  EXPECT_EQ(fine_sort.cuts, coarse_sort.cuts);
  EXPECT_EQ(fine_sort.pairs, coarse_sort.pairs);
  EXPECT_EQ(fine_sort.moves, coarse_sort.moves);
}

}  // namespace
}  // namespace halfspace::fast
