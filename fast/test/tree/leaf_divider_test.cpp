#include "tree/leaf_divider.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "halfspace/fast/display_tree.hpp"
#include "scenes.hpp"
#include "tree/triangles.hpp"

namespace halfspace::fast {
namespace {

/// Triangles that cross each other, and in three planes some that are coplanar,
/// half of them the other way round.
Scene crossing_and_coplanar() {
  SceneData data = crossing_triangles(60).data();
  std::mt19937_64 random(11);
  const auto coordinate = [&random] {
    return static_cast<std::int64_t>(random() % 151) - 75;
  };
  for (int k = 0; k < 36; ++k) {
    const std::int64_t slope = k % 3;
    const std::int64_t x = coordinate();
    const std::int64_t y = coordinate();
    const auto on = [&](std::int64_t u, std::int64_t v) {
      return GridPoint{u, v, slope * u - v + 5};
    };
    const GridPoint p = on(x, y);
    const GridPoint q = on(x + 30, y);
    const GridPoint r = on(x, y + 30);
    if (k % 2 == 0) {
      add_polygon(data, {p, q, r});
    } else {
      add_polygon(data, {p, r, q});
    }
  }
  return made(std::move(data));
}

std::vector<std::pair<PolygonId, bool>> listed(const BspTree& tree,
                                               const Node& node) {
  std::vector<std::pair<PolygonId, bool>> list;
  for_fragments(tree, node, [&](const TreeFragment& fragment) {
    list.emplace_back(fragment.source, fragment.flipped != 0);
    return true;
  });
  return list;
}

/// Expects one tree below two nodes; how many nodes it has.
std::size_t expect_same(const BspTree& p, NodeId p_root, const BspTree& q,
                        NodeId q_root) {
  std::vector<std::pair<NodeId, NodeId>> pairs = {{p_root, q_root}};
  std::size_t count = 0;
  while (!pairs.empty()) {
    const auto [at_p, at_q] = pairs.back();
    pairs.pop_back();
    EXPECT_EQ(at_p == kNoNode, at_q == kNoNode);
    if (at_p == kNoNode || at_q == kNoNode) continue;
    ++count;
    const Node& node = node_at(p, at_p);
    const Node& other = node_at(q, at_q);
    EXPECT_EQ(node.splitter, other.splitter);
    EXPECT_EQ(listed(p, node), listed(q, other));
    pairs.emplace_back(node.positive, other.positive);
    pairs.emplace_back(node.negative, other.negative);
  }
  return count;
}

TEST(LeafDivider, MakesTheTreesThatAllLeavesBecome) {
  const Scene scene = crossing_and_coplanar();
  std::size_t leaves = 0;
  std::size_t nodes = 0;
  std::size_t cuts = 0;
  for (const std::size_t size : {1u, 5u, 40u, 1000u}) {
    DisplayTreeOptions options;
    options.leaf_size = size;
    options.threads = 1;
    const BspTree tree = build_display_tree(scene, options);
    BspTree divided = tree;
    divide_leaves(divided, scene);
    FilterStats stats;
    LeafDivider divider(scene, tree, stats);
    // From the last on: no leaf depends on the one before.
    for (auto id = static_cast<NodeId>(tree.nodes.size()) - 1; id >= 0; --id) {
      const Node& node = node_at(tree, id);
      if (node.splitter != kNoPlane || node.first_fragment == kNoFragment)
        continue;
      ++leaves;
      const BspTree& part = divider.divide(node);
      nodes += expect_same(part, 0, divided, id);
      cuts += part.cut_vertices.size();
    }
  }
  EXPECT_GT(leaves, 50u);
  EXPECT_GT(nodes, 500u);
  EXPECT_GT(cuts, 500u);
}

TEST(LeafDivider, OfALeafWithoutFragmentsIsEmpty) {
  const Scene scene = crossing_triangles(1);
  BspTree tree;
  tree.nodes.emplace_back();
  FilterStats stats;
  LeafDivider divider(scene, tree, stats);
  EXPECT_TRUE(divider.divide(tree.nodes[0]).nodes.empty());
}

}  // namespace
}  // namespace halfspace::fast
