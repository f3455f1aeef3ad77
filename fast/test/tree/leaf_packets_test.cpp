#include "tree/leaf_packets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/tree_file.hpp"
#include "scenes.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {
namespace {

/// Triangles and squares strewn over all of the grid, of a hundredth of its
/// size.
Scene strewn(int count, int grid_bits) {
  std::mt19937_64 random(5);
  SceneData data;
  data.grid_bits = grid_bits;
  const std::int64_t limit = (std::int64_t{1} << (grid_bits - 1)) - 1;
  const std::int64_t size = limit / 50;
  const auto coordinate = [&] {
    return static_cast<std::int64_t>(
               random() % static_cast<std::uint64_t>(2 * limit - size)) -
           limit;
  };
  for (int k = 0; k < count; ++k) {
    const GridPoint at = {coordinate(), coordinate(), coordinate()};
    std::vector<GridPoint> corners = {at,
                                      {at.x + size, at.y, at.z + k % 7},
                                      {at.x + size, at.y + size, at.z + k % 7},
                                      {at.x, at.y + size, at.z}};
    if (k % 3 != 0) corners.resize(3);
    add_polygon(data, corners);
  }
  return made(std::move(data));
}

BspTree tree_with_packets(const Scene& scene) {
  DisplayTreeOptions options;
  options.leaf_size = 100;
  return build_display_tree(scene, options);
}

/// What the blocks of a tree have.
struct Found {
  std::size_t exact = 0;
  std::size_t doubtful = 0;
  std::size_t whole = 0;
};

bool is_whole(const Scene& scene, const TreeReader& reader,
              const TreeFragment& fragment) {
  const auto source = scene.corners(fragment.source);
  const auto corners = reader.corners(fragment);
  return std::equal(
      source.begin(), source.end(), corners.begin(), corners.end(),
      [](VertexId v, const Corner& corner) { return v == corner.vertex; });
}

/// Checks a leaf's blocks with so many corners; their fragments follow `next`,
/// which is moved to the one after them.
template <std::size_t kCorners>
void expect_copies(const Scene& scene, const TreeReader& reader,
                   std::span<const FragmentBlock<kCorners>> blocks,
                   std::int32_t& next, Found& found) {
  for (const FragmentBlock<kCorners>& block : blocks) {
    ASSERT_EQ(block.first_fragment, next);
    ASSERT_GE(block.count, 1);
    ASSERT_LE(block.count, 8);
    for (std::size_t k = 0; k < static_cast<std::size_t>(block.count); ++k) {
      ASSERT_NE(next, kNoFragment);
      const TreeFragment& fragment =
          reader.tree().fragments[static_cast<std::size_t>(next)];
      ASSERT_EQ(fragment.corner_count, kCorners);
      const double error = block.error[k];
      double expected = 0;
      for (std::size_t c = 0; c < kCorners; ++c) {
        const Vertex v = reader.vertex(reader.corners(fragment)[c].vertex);
        const Vertex read = corner_of(block, c, k);
        const double off = std::abs(read.x - v.x) + std::abs(read.y - v.y) +
                           std::abs(read.z - v.z) + v.error;
        ASSERT_LE(off, error);
        expected = std::max(expected, off);
      }
      ASSERT_LE(error, expected * (1 + 0x1p-20));
      const bool says_whole = ((block.whole >> k) & 1u) != 0;
      ASSERT_EQ(says_whole, error == 0 && is_whole(scene, reader, fragment));
      (error == 0 ? found.exact : found.doubtful) += 1;
      found.whole += says_whole ? 1 : 0;
      next = fragment.next;
    }
    ASSERT_EQ(block.whole >> block.count, 0u);
    for (auto k = static_cast<std::size_t>(block.count); k < 8; ++k) {
      for (std::size_t c = 0; c < kCorners; ++c) {
        const Vertex v = corner_of(block, c, k);
        const Vertex first = corner_of(block, c, 0);
        ASSERT_EQ((std::array{v.x, v.y, v.z, v.error}),
                  (std::array{first.x, first.y, first.z, first.error}));
      }
    }
  }
}

Found expect_blocks(const Scene& scene, const BspTree& tree) {
  Found found;
  const TreeReader reader(scene, tree);
  for (const Node& node : tree.nodes) {
    const Blocks blocks = reader.blocks(node);
    if (node.splitter != kNoPlane) {
      EXPECT_TRUE(blocks.triangles.empty() && blocks.quadrangles.empty());
      continue;
    }
    std::int32_t next = node.first_fragment;
    expect_copies<3>(scene, reader, blocks.triangles, next, found);
    expect_copies<4>(scene, reader, blocks.quadrangles, next, found);
    EXPECT_EQ(blocks.rest, next);
    if (::testing::Test::HasFailure()) break;
    std::array<std::size_t, 2> left{};
    for (; next != kNoFragment;
         next = tree.fragments[static_cast<std::size_t>(next)].next) {
      const auto corners = static_cast<std::size_t>(
          tree.fragments[static_cast<std::size_t>(next)].corner_count);
      if (corners <= 4) ++left[corners - 3];
    }
    // Few of a kind are left.
    EXPECT_LT(left[0], 4u);
    if (left[0] == 0) {
      EXPECT_LT(left[1], 4u);
    }
  }
  return found;
}

TEST(FragmentBlocks, AreCopiesOfWhatLeavesBeginWith) {
  const Scene scene = strewn(20000, 26);
  const Found found = expect_blocks(scene, tree_with_packets(scene));
  // Those that are cut have vertices in doubt, and no others.
  EXPECT_EQ(found.exact, found.whole);
  EXPECT_GT(found.whole, 15'000u);
  EXPECT_GT(found.doubtful, 500u);
}

/// Floats are too short for these, so that all are in doubt.
TEST(FragmentBlocks, BoundWhatFloatsLeaveOutOnTheWidestGrid) {
  const Scene scene = strewn(20000, 54);
  const Found found = expect_blocks(scene, tree_with_packets(scene));
  EXPECT_EQ(found.whole, 0u);
  EXPECT_GT(found.doubtful, 2000u);
}

/// A leaf of six triangles, five squares, two triangles and four squares.
BspTree one_leaf(const Scene& scene) {
  BspTree tree;
  tree.nodes.emplace_back();
  tree.nodes[0].first_fragment = 0;
  const auto add = [&](PolygonId polygon) {
    const auto corners = scene.corners(polygon);
    tree.fragments.push_back(
        {polygon, static_cast<std::uint32_t>(tree.corners.size()),
         static_cast<std::uint32_t>(corners.size()) & kMostCornersOfFragment, 0,
         static_cast<std::int32_t>(tree.fragments.size()) + 1});
    for (std::size_t c = 0; c < corners.size(); ++c) {
      tree.corners.push_back({static_cast<std::int32_t>(c), corners[c]});
    }
  };
  for (const PolygonId triangle : {1, 2, 4, 5, 7, 8}) add(triangle);
  for (const PolygonId square : {0, 3, 6, 9, 12}) add(square);
  for (const PolygonId triangle : {10, 11}) add(triangle);
  for (const PolygonId square : {15, 18, 21, 24}) add(square);
  tree.fragments.back().next = kNoFragment;
  return tree;
}

/// How many blocks a leaf has, and what follows them.
struct Numbers {
  std::size_t triangles;
  std::size_t quadrangles;
  std::int32_t rest;
  friend bool operator==(const Numbers&, const Numbers&) = default;
};

Numbers numbers_of(BspTree tree, const Scene& scene) {
  add_blocks(tree, scene);
  const TreeReader reader(scene, tree);
  const Blocks blocks = reader.blocks(tree.nodes[0]);
  return {blocks.triangles.size(), blocks.quadrangles.size(), blocks.rest};
}

TEST(FragmentBlocks, EndWhereTheListGoesElsewhere) {
  const Scene scene = strewn(25, 26);
  const BspTree tree = one_leaf(scene);
  EXPECT_EQ(numbers_of(tree, scene), (Numbers{1, 1, 11}));
  BspTree skips = tree;
  skips.fragments[3].next = 6;
  EXPECT_EQ(numbers_of(skips, scene), (Numbers{1, 0, 6}));
  skips = tree;
  skips.fragments[9].next = 11;
  EXPECT_EQ(numbers_of(skips, scene), (Numbers{1, 1, 11}));
}

TEST(FragmentBlocks, AreNotMadeOfFew) {
  const Scene scene = strewn(25, 26);
  BspTree tree = one_leaf(scene);
  tree.nodes[0].first_fragment = 2;
  EXPECT_EQ(numbers_of(tree, scene), (Numbers{1, 1, 11}));
  for (const std::int32_t first : {3, 5}) {
    tree.nodes[0].first_fragment = first;
    EXPECT_EQ(numbers_of(tree, scene), (Numbers{0, 0, first}));
  }
  tree.nodes[0].first_fragment = 7;
  EXPECT_EQ(numbers_of(tree, scene), (Numbers{0, 1, 11}));
  tree.nodes[0].first_fragment = 8;
  EXPECT_EQ(numbers_of(tree, scene), (Numbers{0, 0, 8}));
}

/// Colours go by the corners' order.
TEST(FragmentBlocks, AreNotCalledWholeWhereCornersBeginElsewhere) {
  const Scene scene = strewn(25, 26);
  BspTree tree = one_leaf(scene);
  add_blocks(tree, scene);
  const std::uint32_t whole = tree.triangles.at(0).whole;
  ASSERT_NE(whole, 0u);
  for (std::ptrdiff_t k = 0; k < 6; ++k) {
    const auto first = tree.corners.begin() + 3 * k;
    std::rotate(first, first + 1, first + 3);
    add_blocks(tree, scene);
    const std::uint32_t others = ~(std::uint32_t{1} << k);
    EXPECT_EQ(tree.triangles[0].whole, whole & others);
    std::rotate(first, first + 2, first + 3);
  }
}

TEST(FragmentBlocks, AreMadeAgainFromFiles) {
  const Scene scene = strewn(2000, 26);
  const BspTree tree = tree_with_packets(scene);
  EXPECT_FALSE(tree.triangles.empty());
  const auto again = decode_tree(encode_tree(tree, scene), scene);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(again->triangles, tree.triangles);
  EXPECT_EQ(again->quadrangles, tree.quadrangles);
  EXPECT_EQ(again->first_blocks, tree.first_blocks);
}

TEST(FragmentBlocks, AreNoneWithoutLeaves) {
  const Scene scene = strewn(2000, 26);
  BspTree tree = tree_with_packets(scene);
  EXPECT_FALSE(tree.triangles.empty());
  EXPECT_FALSE(tree.quadrangles.empty());
  EXPECT_GE(bytes_by_array(tree).blocks,
            tree.triangles.size() * sizeof(FragmentBlock<3>) +
                tree.quadrangles.size() * sizeof(FragmentBlock<4>));
  divide_leaves(tree, scene);
  EXPECT_TRUE(tree.triangles.empty());
  EXPECT_TRUE(tree.quadrangles.empty());
  EXPECT_TRUE(tree.first_blocks.empty());
  EXPECT_TRUE(build(scene, {}).first_blocks.empty());
}

}  // namespace
}  // namespace halfspace::fast
