#include <algorithm>
#include <utility>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "tree/scene_planes.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {

TreeStats stats(const BspTree& tree) {
  TreeStats result;
  std::vector<PolygonId> sources;
  std::vector<std::pair<NodeId, std::size_t>> ahead;  // nodes and their depths
  if (!tree.nodes.empty()) ahead.push_back({0, 1});
  while (!ahead.empty()) {
    const auto [id, depth] = ahead.back();
    ahead.pop_back();
    if (id == kNoNode) continue;
    const Node& node = node_at(tree, id);
    ++result.nodes;
    result.height = std::max(result.height, depth);
    for_fragments(tree, node, [&](const TreeFragment& fragment) {
      sources.push_back(fragment.source);
      return true;
    });
    ahead.push_back({node.positive, depth + 1});
    ahead.push_back({node.negative, depth + 1});
  }
  result.fragments = sources.size();
  std::sort(sources.begin(), sources.end());
  const auto end = std::unique(sources.begin(), sources.end());
  result.splits =
      result.fragments - static_cast<std::size_t>(end - sources.begin());
  return result;
}

TreeName name_of(const BspTree& tree) {
  /// A node to be named, and the index of its parent's name.
  struct Task {
    NodeId node;
    NodeId parent;
    Side side;
  };
  TreeName name;
  std::vector<Task> tasks;
  if (!tree.nodes.empty()) tasks.push_back({0, kNoNode, Side::kOn});
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    if (task.node == kNoNode) continue;
    const Node& node = node_at(tree, task.node);
    const auto id = static_cast<NodeId>(name.size());
    if (task.parent != kNoNode) {
      NodeName& parent = name[static_cast<std::size_t>(task.parent)];
      (task.side == Side::kPositive ? parent.positive : parent.negative) = id;
    }
    name.push_back({node.splitter, {}});
    for_fragments(tree, node, [&](const TreeFragment& fragment) {
      std::vector<EdgeName> edges;
      for (std::uint32_t k = 0; k < fragment.corner_count; ++k) {
        edges.push_back(name_of(tree.corners[fragment.first_corner + k].edge));
      }
      name.back().coincident.push_back(
          {fragment.source, rotated_to_least(std::move(edges))});
      return true;
    });
    tasks.push_back({node.negative, id, Side::kNegative});
    tasks.push_back({node.positive, id, Side::kPositive});
  }
  return name;
}

}  // namespace halfspace::fast
