#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/moving.hpp"
#include "sah/build_state.hpp"
#include "sah/cell_tree.hpp"
#include "scenes.hpp"
#include "tree/scene_planes.hpp"

namespace halfspace::fast {
namespace {

/// `count` triangles strewn over a cube.
Scene strewn(int count, std::int64_t size, int grid_bits) {
  std::mt19937_64 random(1);
  SceneData data;
  data.grid_bits = grid_bits;
  const std::int64_t limit = (std::int64_t{1} << (grid_bits - 1)) - 1;
  const auto coordinate = [&](std::int64_t from, std::int64_t to) {
    const auto width = static_cast<std::uint64_t>(to - from) + 1;
    return from + static_cast<std::int64_t>(random() % width);
  };
  while (data.colors.size() < static_cast<std::size_t>(count)) {
    const GridPoint at = {coordinate(-limit, limit - size),
                          coordinate(-limit, limit - size),
                          coordinate(-limit, limit - size)};
    const auto near = [&](std::int64_t dx, std::int64_t dy) {
      return GridPoint{at.x + dx, at.y + dy, at.z + coordinate(0, size)};
    };
    add_polygon(data, {near(0, 0), near(size, 0), near(0, size)});
  }
  return made(std::move(data));
}

template <class T>
bool same_bytes(const std::vector<T>& p, const std::vector<T>& q) {
  return p.size() == q.size() &&
         (p.empty() ||
          std::memcmp(p.data(), q.data(), p.size() * sizeof(T)) == 0);
}

/// Whether no byte differs but those between members.
void expect_same(const BspTree& p, const BspTree& q) {
  EXPECT_TRUE(same_bytes(p.nodes, q.nodes));
  EXPECT_TRUE(same_bytes(p.fragments, q.fragments));
  EXPECT_EQ(p.corners, q.corners);
  EXPECT_TRUE(same_bytes(p.cut_vertices, q.cut_vertices));
  EXPECT_EQ(p.free_planes, q.free_planes);
  EXPECT_EQ(p.boxes, q.boxes);
  EXPECT_EQ(p.triangles, q.triangles);
  EXPECT_EQ(p.quadrangles, q.quadrangles);
  EXPECT_EQ(p.first_blocks, q.first_blocks);
}

TEST(DisplayTree, DoesNotDependOnTheNumberOfThreads) {
  const Scene scene = strewn(60000, 1 << 20, 26);
  DisplayTreeOptions options;
  options.threads = 1;
  const BspTree one = build_display_tree(scene, options);
  EXPECT_GT(one.cut_vertices.size(), 1000u);
  for (const int threads : {2, 3, 0}) {
    options.threads = threads;
    expect_same(one, build_display_tree(scene, options));
  }
}

/// The same polygons on another grid.
Scene on_grid(const Scene& scene, int grid_bits) {
  SceneData data = scene.data();
  data.grid_bits = grid_bits;
  return made(std::move(data));
}

TEST(DisplayTree, CutsAreAsSureOnAGridThatTheSceneTakesLittleOf) {
  const Scene scene = strewn(5000, 1 << 20, 26);
  const BspTree coarse = build_display_tree(on_grid(scene, 40));
  const BspTree fine = build_display_tree(on_grid(scene, 54));
  EXPECT_GT(coarse.cut_vertices.size(), 500u);
  expect_same(coarse, fine);
  const BspTree papers = build(on_grid(scene, 40), {});
  EXPECT_TRUE(same_bytes(papers.cut_vertices,
                         build(on_grid(scene, 54), {}).cut_vertices));
}

TEST(DisplayTree, BoundsHoldForWhatHasMoved) {
  const Scene scene = on_grid(strewn(10, 1 << 10, 26), 54);
  const DisplayTreeOptions options;
  const BuildState before(scene, options);
  EXPECT_LT(before.most, 0x1p27);
  SceneData data = scene.data();
  for (GridPoint& p : data.vertices) p.x += std::int64_t{1} << 50;
  const Scene moved = made(std::move(data));
  EXPECT_EQ(BuildState(moved, before).most, 0x1p53);
}

TEST(DisplayTree, OfNothingHasNoNodes) {
  EXPECT_TRUE(build_display_tree(Scene()).nodes.empty());
}

TEST(DisplayTree, OfOnePolygonIsALeaf) {
  SceneData data;
  add_polygon(data, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const BspTree tree = build_display_tree(made(std::move(data)));
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_EQ(tree.nodes[0].splitter, kNoPlane);
  EXPECT_EQ(tree.fragments.size(), 1u);
  EXPECT_EQ(tree.boxes[0], (Box{{0, 0, 0}, {1, 1, 0}}));
}

TEST(DisplayTree, IdenticalPolygonsAreOneNodesList) {
  SceneData data;
  for (int k = 0; k < 1000; ++k) {
    add_polygon(data, {{0, 0, 3}, {100, 7, 50}, {9, 100, 0}});
  }
  const BspTree tree = build_display_tree(made(std::move(data)));
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_NE(tree.nodes[0].splitter, kNoPlane);
  ASSERT_EQ(tree.fragments.size(), 1000u);
  for (std::size_t k = 0; k < 1000; ++k) {
    EXPECT_EQ(tree.fragments[k].source, static_cast<PolygonId>(k));
    EXPECT_EQ(tree.fragments[k].flipped, 0u);
  }
}

/// Triangles in planes of one coordinate, many of them in each: the splitters
/// fall into those planes.
TEST(DisplayTree, PolygonsInAFreePlaneAreItsNodes) {
  SceneData data;
  for (std::int64_t z = 0; z < 64; ++z) {
    for (std::int64_t k = 0; k < 4; ++k) {
      add_polygon(data, {{0, 0, z}, {500 + k, 0, z}, {0, 500, z}});
    }
  }
  const BspTree tree = build_display_tree(made(std::move(data)));
  EXPECT_EQ(tree.fragments.size(), 256u);
  std::size_t in_nodes = 0;
  for (const Node& node : tree.nodes) {
    if (node.splitter == kNoPlane) continue;
    for (std::int32_t f = node.first_fragment; f != kNoFragment;) {
      ++in_nodes;
      f = tree.fragments[static_cast<std::size_t>(f)].next;
    }
  }
  EXPECT_GT(in_nodes, 200u);
}

/// Triangles in slanted planes, all of them parallel: planes across an axis
/// would cut, their own part them without.
TEST(DisplayTree, ParallelPolygonsAreHardlyCut) {
  std::mt19937_64 random(3);
  SceneData data;
  for (std::int64_t k = 0; k < 3000; ++k) {
    const auto coordinate = [&random] {
      return static_cast<std::int64_t>(random() % 1'000'000);
    };
    // In the plane x + 2 y + 3 z = 6 h.
    const std::int64_t h = coordinate();
    const auto at = [h](std::int64_t u, std::int64_t v) {
      return GridPoint{6 * h - 2 * u - 3 * v, u, v};
    };
    const std::int64_t u = coordinate();
    const std::int64_t v = coordinate();
    add_polygon(data, {at(u, v), at(u + 300'000, v), at(u, v + 300'000)});
  }
  const BspTree tree = build_display_tree(made(std::move(data)));
  EXPECT_LT(tree.fragments.size(), 3010u);
  EXPECT_GT(tree.nodes.size(), 1000u);
}

TEST(DisplayTree, GrowsLittleWhereTrianglesAreSmall) {
  const Scene scene = strewn(50000, 1 << 19, 26);
  const BspTree tree = build_display_tree(scene);
  EXPECT_LT(tree.fragments.size(), 2 * scene.polygon_count());
  EXPECT_LT(bytes_of(tree), 100 * tree.fragments.size());
  EXPECT_LT(bytes_of(tree), 300 * scene.polygon_count());
  // A tree, not a chain.
  EXPECT_LT(stats(tree).height, 40u);
}

/// Where every triangle crosses most others, a tree without leaves would have a
/// thousand fragments for each.
TEST(DisplayTree, GrowsByNoMoreThanItMay) {
  const Scene scene = strewn(2000, (std::int64_t{1} << 26) - 1000, 26);
  const BspTree tree = build_display_tree(scene);
  const DisplayTreeOptions options;
  const double most = options.most_cuts * 2000 + 100'000;
  EXPECT_LT(static_cast<double>(tree.fragments.size()), 2 * most);
  EXPECT_GT(static_cast<double>(tree.fragments.size()), most / 4);
}

/// Many more polygons than a drawer remembers the planes of, whose pixels are
/// decided by depth.
TEST(DisplayTree, LeavesShowWhatNodesShow) {
  const Scene scene = strewn(3000, 1 << 23, 26);
  CameraData data;
  data.perspective = false;
  data.eye = {3, 5, -256};
  data.s0 = {-(Int128{1} << 33), -(Int128{1} << 33), 0};
  data.sx = {Int128{1} << 27, 0, 0};
  data.sy = {0, Int128{1} << 27, 0};
  data.width_px = data.height_px = 128;
  const Camera camera = *make_camera(data, 26);
  const BspTree leaves = build_display_tree(scene);
  EXPECT_TRUE(has_leaves(leaves));
  const Rendering found = render(scene, leaves, camera, {});
  const Rendering expected = render(scene, build(scene, {}), camera, {});
  EXPECT_EQ(found.items, expected.items);
  EXPECT_GT(expected.pixels_painted, 10'000u);
}

TEST(DisplayTree, IsDividedOnTheWidestGridToo) {
  const Scene scene = strewn(3000, std::int64_t{1} << 46, 54);
  DisplayTreeOptions options;
  options.leaf_size = 16;
  const BspTree tree = build_display_tree(scene, options);
  EXPECT_GT(tree.nodes.size(), 250u);
}

TEST(DisplayTree, OfLeavesWithoutPolygonsIsDividedToo) {
  BspTree leaf;
  leaf.nodes.emplace_back();
  leaf.nodes[0].splitter = kNoPlane;
  BspTree tree = leaf;
  divide_leaves(tree, Scene());
  EXPECT_TRUE(tree.nodes.empty());
  const Scene scene = strewn(3, 1 << 10, 26);
  tree = leaf;
  divide_leaves(tree, scene);
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_EQ(tree.nodes[0].first_fragment, kNoFragment);
  // It can be inserted into.
  insert(tree, scene, 1);
  EXPECT_EQ(stats(tree).fragments, 1u);
}

TEST(DisplayTree, TellsHowFarItIs) {
  const Scene scene = strewn(40000, 1 << 19, 26);
  DisplayTreeOptions options;
  std::vector<double> told;
  options.progress = [&](double share) {
    told.push_back(share);
    return true;
  };
  const BspTree tree = build_display_tree(scene, options);
  ASSERT_GT(told.size(), 10u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.front(), 0);
  EXPECT_GT(told.back(), 0.9);
  EXPECT_LE(told.back(), 1);
  options.progress = nullptr;
  expect_same(tree, build_display_tree(scene, options));
}

/// Boxes in rows, more than one thread's job has, and triangles that reach into
/// them.
std::vector<MovingObject> boxes_in_rows() {
  constexpr std::int64_t kStep = 1 << 22;
  std::vector<MovingObject> objects;
  for (std::int64_t k = 0; k < 7 * 7 * 5; ++k) {
    const GridPoint low = {(k % 7 - 3) * kStep, (k / 7 % 7 - 3) * kStep,
                           (k / 49 - 2) * kStep};
    constexpr std::int64_t kSide = kStep / 2;
    objects.push_back(
        {1, {low, {low.x + kSide, low.y + kSide, low.z + kSide}}});
  }
  return objects;
}

TEST(DisplayTree, ManyRegionsAreLeavesOnTheirSidesOfAllSplitters) {
  const std::vector<MovingObject> objects = boxes_in_rows();
  const Scene scene = strewn(4000, 1 << 20, 26);
  DisplayTreeOptions options;
  const auto built = [&](int threads) {
    options.threads = threads;
    KeptCells cells(objects, true);
    FilterStats stats;
    return build_cell_tree(scene, cells, options, stats);
  };
  const KeptTree kept = built(1);
  const BspTree& tree = kept.tree;
  const KeptTree by_three = built(3);
  expect_same(tree, by_three.tree);
  EXPECT_EQ(kept.node_of_object, by_three.node_of_object);
  std::vector<NodeId> parents(tree.nodes.size(), kNoNode);
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    for (const NodeId child :
         {tree.nodes[n].positive, tree.nodes[n].negative}) {
      if (child == kNoNode) continue;
      // Nodes come before their subtrees, and have one parent.
      ASSERT_GT(child, static_cast<NodeId>(n));
      ASSERT_EQ(parents[static_cast<std::size_t>(child)], kNoNode);
      parents[static_cast<std::size_t>(child)] = static_cast<NodeId>(n);
    }
  }
  for (std::size_t k = 0; k < objects.size(); ++k) {
    NodeId id = kept.node_of_object[k];
    ASSERT_NE(id, kNoNode);
    const Node& leaf = tree.nodes[static_cast<std::size_t>(id)];
    EXPECT_EQ(leaf.splitter, kNoPlane);
    EXPECT_EQ(leaf.first_fragment, kNoFragment);
    const auto& [low, high, hull, slanted] = objects[k].region;
    int splitters = 0;
    while (parents[static_cast<std::size_t>(id)] != kNoNode) {
      const NodeId parent = parents[static_cast<std::size_t>(id)];
      const Node& node = tree.nodes[static_cast<std::size_t>(parent)];
      const bool is_positive = node.positive == id;
      const Plane& p = node.plane;
      for (const GridPoint& corner : {low, high}) {
        const double side = p.a * static_cast<double>(corner.x) +
                            p.b * static_cast<double>(corner.y) +
                            p.c * static_cast<double>(corner.z) + p.d;
        EXPECT_TRUE(is_positive ? side >= 0 : side <= 0) << k;
      }
      ++splitters;
      id = parent;
    }
    EXPECT_EQ(id, 0);
    EXPECT_GE(splitters, 6);
  }
}

TEST(DisplayTree, CutsAtRegionsLieInThePlanesThatTheyName) {
  const std::vector<MovingObject> objects = boxes_in_rows();
  const Scene scene = strewn(4000, 1 << 20, 26);
  KeptCells cells(objects, true);
  FilterStats stats;
  const BspTree tree = build_cell_tree(scene, cells, {}, stats).tree;
  const auto polygons = static_cast<PlaneId>(scene.polygon_count());
  const auto vertices = static_cast<std::int32_t>(scene.data().vertices.size());
  int cuts = 0;
  for (const TreeFragment& fragment : tree.fragments) {
    for (std::uint32_t k = 0; k < fragment.corner_count; ++k) {
      const Corner& corner = tree.corners[fragment.first_corner + k];
      if (is_source(corner.edge) || splitter_of(corner.edge) < polygons)
        continue;
      const FreePlane plane = tree.free_planes[static_cast<std::size_t>(
          splitter_of(corner.edge) - polygons)];
      ASSERT_LT(plane.axis, 3);
      if (corner.vertex < vertices) continue;
      const Vertex& v =
          tree.cut_vertices[static_cast<std::size_t>(corner.vertex - vertices)];
      const std::array<double, 3> at = {v.x, v.y, v.z};
      EXPECT_NEAR(at[static_cast<std::size_t>(plane.axis)],
                  static_cast<double>(plane.coordinate), 1e-3);
      ++cuts;
    }
  }
  EXPECT_GT(cuts, 1000);
}

TEST(DisplayTree, StopsWhenToldTo) {
  const Scene scene = strewn(40000, 1 << 19, 26);
  DisplayTreeOptions options;
  int calls = 0;
  options.progress = [&](double) { return ++calls < 3; };
  EXPECT_TRUE(build_display_tree(scene, options).nodes.empty());
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace halfspace::fast
