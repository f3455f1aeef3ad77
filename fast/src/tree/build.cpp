#include "halfspace/fast/build.hpp"

#include <algorithm>
#include <utility>

#include "halfspace/assert.hpp"
#include "tree/autopartition.hpp"
#include "tree/leaf_divider.hpp"
#include "tree/node_boxes.hpp"

namespace halfspace::fast {
namespace {

/// Lays the fragments out node by node, without those in no list.
void drop_unused_fragments(BspTree& tree) {
  std::vector<TreeFragment> kept;
  for (Node& node : tree.nodes) {
    std::int32_t f = node.first_fragment;
    if (f != kNoFragment) {
      node.first_fragment = static_cast<std::int32_t>(kept.size());
    }
    while (f != kNoFragment) {
      kept.push_back(tree.fragments[static_cast<std::size_t>(f)]);
      f = kept.back().next;
      const auto next = static_cast<std::int32_t>(kept.size());
      kept.back().next = f == kNoFragment ? kNoFragment : next;
    }
  }
  kept.shrink_to_fit();
  tree.fragments = std::move(kept);
}

}  // namespace

BspTree build(const Scene& scene, const BuildOptions& options) {
  FilterStats stats;
  return build(scene, options, stats);
}

BspTree build(const Scene& scene, const BuildOptions& options,
              FilterStats& stats) {
  return build(scene, options, stats, nullptr);
}

BspTree build(const Scene& scene, const BuildOptions& options,
              FilterStats& stats, const Progress& progress) {
  HALFSPACE_ASSERT(options.candidates >= 1);
  BspTree tree;
  if (!Autopartition<ScenePlaneTable>(scene, options, tree, stats, progress)
           .run())
    return {};
  drop_unused_corners(tree);
  tree.nodes.shrink_to_fit();
  tree.fragments.shrink_to_fit();
  tree.cut_vertices.shrink_to_fit();
  add_boxes(tree, scene);
  return tree;
}

bool has_leaves(const BspTree& tree) {
  return std::any_of(
      tree.nodes.begin(), tree.nodes.end(),
      [](const Node& node) { return node.splitter == kNoPlane; });
}

void divide_leaves(BspTree& tree, const Scene& scene) {
  if (!has_leaves(tree)) return;
  if (scene.polygon_count() == 0) {
    tree = {};
    return;
  }
  FilterStats stats;
  const Progress silent;
  Autopartition<ScenePlaneTable> partition(scene, kLeafOptions, tree, stats,
                                           silent);
  std::vector<FragmentRef> fragments;
  const auto count = static_cast<NodeId>(tree.nodes.size());
  for (NodeId id = 0; id < count; ++id) {
    Node& node = node_at(tree, id);
    if (node.splitter != kNoPlane) continue;
    // Their old entries are in no list then.
    fragments_of_leaf(tree, node, fragments);
    node.first_fragment = kNoFragment;
    if (fragments.empty()) {
      // Any plane will do.
      node.splitter = 0;
      node.plane = filter_plane(plane_of(scene, 0)).plane;
      continue;
    }
    partition.divide(id, fragments, leaf_seed(id));
  }
  drop_unused_fragments(tree);
  drop_unused_corners(tree);
  add_boxes(tree, scene);
  // `= {}` would keep the memory.
  tree.triangles = std::vector<FragmentBlock<3>>();
  tree.quadrangles = std::vector<FragmentBlock<4>>();
  tree.first_blocks = std::vector<FirstBlocks>();
}

}  // namespace halfspace::fast
