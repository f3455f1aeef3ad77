#include "halfspace/ref/build.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "halfspace/ref/splitter.hpp"
#include "small_stack.hpp"
#include "walls.hpp"

namespace halfspace::ref {
namespace {

using enum EdgeName::Kind;
using enum RootRule;

std::vector<Fragment> fragments_of(const Scene& scene) {
  std::vector<Fragment> fragments;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    fragments.push_back(whole(scene, static_cast<PolygonId>(p)));
  }
  return fragments;
}

/// Seven walls on which the rules differ; 1 and 3 lie in one plane, and some
/// end on the plane of another:
///
///   polygon     0  1  2  3  4  5  6
///   out-degree  1  1  0  1  0  0  2
///   in-degree   0  0  0  2  1  0  2
///   |IN - OUT|  5  2  6  2  6  4  0
Polygons seven_walls() {
  return {wall_z(1, 2, 3), wall_x(5, 7, 8), wall_x(8, 1, 2), wall_x(5, 0, 6),
          wall_x(1, 2, 7), wall_x(2, 3, 6), wall_z(3, 4, 8)};
}

std::size_t chosen(const BuildOptions& options, std::uint64_t key) {
  const Scene scene = scene_of(seven_walls());
  return choose_root(planes_of(scene), fragments_of(scene), options, key);
}

TEST(ChooseRoot, EveryRuleMinimisesItsOwnNumber) {
  EXPECT_EQ(chosen({.rule = kFirst}, 0), 0u);
  EXPECT_EQ(chosen({.rule = kFewestCuts}, 0), 2u);
  EXPECT_EQ(chosen({.rule = kH1}, 0), 2u);
  EXPECT_EQ(chosen({.rule = kH2}, 0), 3u);
  EXPECT_EQ(chosen({.rule = kH3}, 0), 4u);
  EXPECT_EQ(chosen({.rule = kH4}, 0), 6u);
  EXPECT_EQ(chosen({.rule = kH5}, 0), 2u);
  // 50, 52, 6, 52, 6, 4, 100 with the weight 50; 7, 4, 6, 4, 6, 4, 4 with 2.
  EXPECT_EQ(chosen({.rule = kH6, .cut_weight = 50}, 0), 5u);
  EXPECT_EQ(chosen({.rule = kH6, .cut_weight = 2}, 0), 1u);
}

TEST(ChooseRoot, CandidatesAreDrawnByKeyWithoutRepetition) {
  // Worked out from S3.4: key, the two drawn, the one with fewer cuts. Equals
  // go to the lower id, whichever was drawn first (keys 2 and 3).
  const std::pair<std::uint64_t, std::size_t> pairs[] = {
      {0, 2},   // 2 and 5
      {1, 3},   // 6 and 3
      {2, 0},   // 3 and 0
      {3, 4},   // 3 and 4
      {7, 4},   // 1 and 4
      {11, 5},  // 5 and 6
  };
  for (const auto& [key, root] : pairs) {
    EXPECT_EQ(chosen({.rule = kRandom, .candidates = 2}, key), root) << key;
  }
  // Six of seven miss one; with repetitions they would miss more.
  EXPECT_EQ(chosen({.rule = kRandom, .candidates = 6}, 3), 4u);  // all but 2
  EXPECT_EQ(chosen({.rule = kRandom, .candidates = 6}, 0), 2u);  // all but 6
  for (std::uint64_t key = 0; key < 20; ++key) {
    EXPECT_EQ(chosen({.rule = kRandom, .candidates = 7}, key), 2u);
    EXPECT_EQ(chosen({.rule = kRandom, .candidates = 1000}, key), 2u);
  }
}

TEST(Build, WhatASplitterCutsGoesToBothSides) {
  const Scene scene = scene_of({wall_x(0, -2, 2), wall_z(0, -2, 2)});
  const TreeName expected = {
      {0,
       {{0, {{kSource, 0}, {kSource, 1}, {kSource, 2}, {kSource, 3}}}},
       1,
       2},
      {1, {{1, {{kSource, 0}, {kSource, 1}, {kSource, 2}, {kSplitter, 0}}}}},
      {1, {{1, {{kSource, 0}, {kSplitter, 0}, {kSource, 2}, {kSource, 3}}}}},
  };
  const BspTree tree = build(scene, {.rule = kFirst});
  EXPECT_EQ(name_of(tree), expected);
  EXPECT_EQ(stats(tree),
            (TreeStats{.nodes = 3, .height = 2, .fragments = 3, .splits = 1}));
}

TEST(Build, CoincidentPolygonsOfEitherDirectionShareANode) {
  const Scene scene =
      scene_of({wall_x(3, 0, 1), wall_x(5, 0, 1), turned_over(wall_x(5, 4, 6)),
                wall_x(5, 8, 9), wall_x(7, 0, 1)});
  const BspTree tree = build(scene, {.rule = kH4});
  EXPECT_EQ(stats(tree),
            (TreeStats{.nodes = 3, .height = 2, .fragments = 5, .splits = 0}));
  const TreeName name = name_of(tree);
  // Balanced: x = 5, then x = 7 on its positive and x = 3 on its negative side.
  ASSERT_EQ(name.size(), 3u);
  EXPECT_EQ(name[0].splitter, 1);
  ASSERT_EQ(name[0].coincident.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(name[0].coincident[k].source, static_cast<PolygonId>(k + 1));
  }
  EXPECT_EQ(name[0].positive, 1);
  EXPECT_EQ(name[0].negative, 2);
  EXPECT_EQ(name[1].splitter, 4);
  EXPECT_EQ(name[2].splitter, 0);
}

TEST(Build, HeightIsThatOfTheDeeperSide) {
  const std::vector<GridPoint> root = wall_x(0, 0, 1);
  for (const int side : {-1, 1}) {
    const Scene scene =
        scene_of({root, wall_x(side, 0, 1), wall_x(2 * side, 0, 1),
                  wall_x(3 * side, 0, 1), wall_x(-side, 0, 1)});
    EXPECT_EQ(stats(build(scene, {.rule = kFirst})).height, 4u) << side;
  }
}

/// The splitters, in the order of a tree's name, of walls x = first, ...,
/// first + count - 1 when each root is the one draw from its list.
void expect_drawn(std::int32_t first, std::uint64_t count, std::uint64_t key,
                  std::vector<PolygonId>& splitters) {
  if (count == 0) return;
  const auto r = draw(key, 0, count);
  const auto root = first + static_cast<std::int32_t>(r);
  splitters.push_back(root);
  expect_drawn(root + 1, count - r - 1, positive_key(key), splitters);
  expect_drawn(first, r, negative_key(key), splitters);
}

TEST(Build, EveryPlaceDrawsByItsOwnKey) {
  Polygons walls;
  for (int x = 0; x < 40; ++x) walls.push_back(wall_x(x, 0, 1));
  const Scene scene = scene_of(walls);
  for (const std::uint64_t seed : {1u, 2u, 99u}) {
    std::vector<PolygonId> expected;
    expect_drawn(0, 40, root_key(seed), expected);
    std::vector<PolygonId> found;
    for (const NodeName& node : name_of(
             build(scene, {.rule = kRandom, .candidates = 1, .seed = seed}))) {
      found.push_back(node.splitter);
    }
    EXPECT_EQ(found, expected) << seed;
  }
}

TEST(Build, NothingGivesAnEmptyTree) {
  const BspTree tree = build(Scene(), {});
  EXPECT_TRUE(tree.nodes.empty());
  EXPECT_EQ(stats(tree), TreeStats());
  EXPECT_TRUE(name_of(tree).empty());
}

TEST(Build, ADeepTreeNeedsNoDeepStack) {
  constexpr std::int32_t kCount = 3000;
  Polygons walls;
  for (std::int32_t x = 0; x < kCount; ++x) walls.push_back(wall_x(x, 0, 1));
  const Scene scene = scene_of(walls);
  on_small_stack([&] {
    const BspTree tree = build(scene, {.rule = kFirst});
    EXPECT_EQ(stats(tree).height, static_cast<std::size_t>(kCount));
  });
}

TEST(Insert, PolygonByPolygonGivesTheTreeOfTheFirst) {
  Polygons walls = seven_walls();
  for (std::size_t first = 0; first < walls.size(); ++first) {
    const Scene scene = scene_of(walls);
    const std::vector<Plane> planes = planes_of(scene);
    BspTree tree;
    for (const Fragment& polygon : fragments_of(scene)) {
      insert(tree, polygon, planes[static_cast<std::size_t>(polygon.source)]);
    }
    EXPECT_EQ(name_of(tree), name_of(build(scene, {.rule = kFirst}))) << first;
    EXPECT_GT(stats(tree).splits, 0u);
    std::rotate(walls.begin(), walls.begin() + 1, walls.end());
  }
}

TEST(Insert, CoincidentPolygonsStayInOrderOfId) {
  const Scene scene = scene_of(
      {wall_x(5, 0, 1), turned_over(wall_x(5, 2, 3)), wall_x(5, 4, 5)});
  const std::vector<Plane> planes = planes_of(scene);
  BspTree tree;
  for (const PolygonId id : {1, 2, 0}) {
    insert(tree, whole(scene, id), planes[static_cast<std::size_t>(id)]);
  }
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_EQ(tree.nodes[0].splitter, 1);
  EXPECT_LT(sign(tree.nodes[0].plane.a), 0);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(tree.nodes[0].coincident[k].source, static_cast<PolygonId>(k));
  }
}

TEST(Insert, AChainOf100000NodesNeedsNoDeepStack) {
  on_small_stack([] {
    constexpr std::int32_t kCount = 100000;
    BspTree tree = chain(kCount);
    // Past all nodes but the two last, which cut it.
    Fragment last = whole(scene_of({wall_z(1, kCount - 3, kCount)}), 0);
    last.source = kCount;
    const Plane plane = plane_of(last.vertices);
    insert(tree, std::move(last), plane);
    EXPECT_EQ(stats(tree), (TreeStats{.nodes = kCount + 3,
                                      .height = kCount + 1,
                                      .fragments = kCount + 3,
                                      .splits = 2}));
    const TreeName name = name_of(tree);
    EXPECT_EQ(name[0].positive, 1);
    // Pre-order: the walls, the part beyond the last, the others upwards.
    EXPECT_EQ(name[kCount - 1].positive, kCount);
    EXPECT_EQ(name[kCount - 1].negative, kCount + 1);
    EXPECT_EQ(name[kCount - 2].negative, kCount + 2);
    EXPECT_EQ(name[kCount + 2].splitter, kCount);
  });
}

}  // namespace
}  // namespace halfspace::ref
