#include "halfspace/ref/traverse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "small_stack.hpp"
#include "walls.hpp"

namespace halfspace::ref {
namespace {

using Order = void (*)(const BspTree&, const Camera&, const Visitor&);

/// A camera whose eye is at (x, 4, z), or looks from there if at infinity.
Camera camera_at(std::int64_t x, std::int64_t z, bool perspective) {
  CameraData data;
  data.perspective = perspective;
  data.eye = {x * 256, perspective ? 4 * 256 : 0, z * 256};
  // The three vectors differ in direction from the eye's, wherever that is.
  data.s0 = perspective
                ? LatticeVector{data.eye.x + 3, data.eye.y + 5, data.eye.z + 7}
                : LatticeVector{0, 0, 0};
  data.sx = {11, 13, 256};
  data.sy = {17, 256, 19};
  data.width_px = 1;
  data.height_px = 1;
  return camera_of(data);
}

/// The sources of the first `most` fragments that the order displays.
Ids displayed(Order order, const BspTree& tree, const Camera& camera,
              std::size_t most = 1000) {
  Ids ids;
  order(tree, camera, [&](const Node& node, const Fragment& fragment) {
    EXPECT_EQ(relation(fragment, node.plane), Relation::kCoincident);
    ids.push_back(fragment.source);
    return ids.size() < most;
  });
  return ids;
}

Ids reversed(Ids ids) {
  std::reverse(ids.begin(), ids.end());
  return ids;
}

/// Walls x = 0 (two in one plane, of either direction), x = 4 and, between
/// them, z = 0, and z = 1 turned over.
///
///                x = 0 (0 and 4)
///       negative /    \ positive
///         x = -4 (5)   x = 4 (1)
///                      / negative
///                  z = 0 (2)
///                      \ positive
///                      z = 1 (3, turned over)
BspTree room() {
  const Scene scene =
      scene_of({wall_x(0, -5, 0), wall_x(4, -5, 5), wall_z(0, 1, 3),
                turned_over(wall_z(1, 1, 3)), turned_over(wall_x(0, 1, 5)),
                wall_x(-4, -5, 5)});
  return build(scene, {.rule = RootRule::kFirst});
}

void expect_orders(const Camera& camera, const Ids& front_to_back_ids) {
  const BspTree tree = room();
  EXPECT_EQ(displayed(front_to_back, tree, camera), front_to_back_ids);
  EXPECT_EQ(displayed(back_to_front, tree, camera),
            reversed(front_to_back_ids));
}

TEST(Traverse, NearSubtreeThenNodeThenFarSubtree) {
  expect_orders(camera_at(9, 9, true), {1, 3, 2, 0, 4, 5});
  expect_orders(camera_at(2, 9, true), {3, 2, 1, 0, 4, 5});
  expect_orders(camera_at(2, -9, true), {2, 3, 1, 0, 4, 5});
  expect_orders(camera_at(-2, -9, true), {5, 0, 4, 2, 3, 1});
  expect_orders(camera_at(-9, 9, true), {5, 0, 4, 3, 2, 1});
}

TEST(Traverse, AtInfinityTheDirectionCounts) {
  // Towards the viewer is (1, 0, 1): every wall is seen from its positive side
  // but the one turned over.
  expect_orders(camera_at(1, 1, false), {1, 3, 2, 0, 4, 5});
  expect_orders(camera_at(-1, -1, false), {5, 0, 4, 2, 3, 1});
}

TEST(Traverse, OnASplitterPositiveIsNearAndTheNodeUnseen) {
  expect_orders(camera_at(0, 9, true), {3, 2, 1, 5});
  expect_orders(camera_at(4, 9, true), {3, 2, 0, 4, 5});
  expect_orders(camera_at(2, 0, true), {3, 1, 0, 4, 5});
  // Both z walls lie in planes that hold the eye or its direction.
  expect_orders(camera_at(1, 0, false), {1, 0, 4, 5});
}

TEST(Traverse, EmptyTreesDisplayNothing) {
  for (const Order order : {front_to_back, back_to_front}) {
    EXPECT_TRUE(displayed(order, BspTree(), camera_at(9, 9, true)).empty());
  }
}

TEST(Traverse, ADisplayThatSaysStopIsNotCalledAgain) {
  for (const Order order : {front_to_back, back_to_front}) {
    const Ids all = displayed(order, room(), camera_at(9, 9, true));
    for (std::size_t most = 1; most <= all.size(); ++most) {
      const Ids some = displayed(order, room(), camera_at(9, 9, true), most);
      Ids expected = all;
      expected.resize(most);
      EXPECT_EQ(some, expected) << most;
    }
  }
}

TEST(Traverse, AChainOf100000NodesNeedsNoDeepStack) {
  on_small_stack([] {
    constexpr std::int32_t kCount = 100000;
    const BspTree tree = chain(kCount);
    Ids ascending;
    for (std::int32_t i = 0; i < kCount; ++i) ascending.push_back(i);
    const Camera left = camera_at(-9, 3, true);
    const Camera right = camera_at(kCount + 9, 3, true);
    EXPECT_EQ(displayed(front_to_back, tree, left, kCount), ascending);
    EXPECT_EQ(displayed(back_to_front, tree, right, kCount), ascending);
    EXPECT_EQ(displayed(back_to_front, tree, left, kCount),
              reversed(ascending));
  });
}

}  // namespace
}  // namespace halfspace::ref
