#include <span>
#include <utility>
#include <vector>

#include "box/box.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/build.hpp"
#include "tree/fragment_splitter.hpp"
#include "tree/leaf_packets.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {
namespace {

/// A fragment on its way down: at `node` or, if there is none, at its place.
struct Step {
  FragmentRef fragment;
  Box box;
  NodeId node;
  NodeId parent;
  Side side;
};

/// Puts the fragment into the node's list, which is in id order.
void put(BspTree& tree, NodeId node, const FragmentRef& fragment,
         const Plane& plane) {
  const std::int32_t added =
      add_fragment(tree, fragment, opposed(plane, node_at(tree, node).plane));
  std::int32_t* link = &node_at(tree, node).first_fragment;
  while (*link != kNoFragment) {
    TreeFragment& next = tree.fragments[static_cast<std::size_t>(*link)];
    if (next.source > fragment.source) break;
    link = &next.next;
  }
  tree.fragments.back().next = *link;
  *link = added;
}

/// Makes a node of the fragment.
void make_node(BspTree& tree, const Step& step, const Plane& plane) {
  const auto id = static_cast<NodeId>(tree.nodes.size());
  if (step.parent != kNoNode) set_child(tree, step.parent, step.side, id);
  Node node;
  node.splitter = step.fragment.source;
  node.plane = plane;
  tree.nodes.push_back(node);
  put(tree, id, step.fragment, plane);
}

Box box_of(const BspTree& tree, const FragmentSplitter& splitter,
           const FragmentRef& fragment) {
  Box box = kEmptyBox;
  for (std::uint32_t k = 0; k < fragment.count; ++k) {
    extend(box, splitter.vertex(tree.corners[fragment.first + k].vertex));
  }
  return box;
}

/// Copies what is left of a tree, node, positive subtree, negative subtree, to
/// arrays without gaps.
class TreeCopy {
 public:
  TreeCopy(const Scene& scene, const BspTree& from)
      : from_(from),
        vertex_count_(static_cast<std::int32_t>(scene.data().vertices.size())),
        copies_(from.cut_vertices.size(), -1) {
    to_.free_planes = from.free_planes;
    to_.slanted = from.slanted;
  }

  BspTree copy(NodeId root) {
    struct Task {
      NodeId node;
      NodeId parent;
      Side side;
    };
    std::vector<Task> tasks = {{root, kNoNode, Side::kOn}};
    const bool has_boxes = from_.boxes.size() == from_.nodes.size();
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      if (task.node == kNoNode) continue;
      const Node& node = node_at(from_, task.node);
      const auto id = static_cast<NodeId>(to_.nodes.size());
      if (task.parent != kNoNode) set_child(to_, task.parent, task.side, id);
      to_.nodes.push_back(node);
      to_.nodes.back().positive = to_.nodes.back().negative = kNoNode;
      if (has_boxes)
        to_.boxes.push_back(from_.boxes[static_cast<std::size_t>(task.node)]);
      copy_fragments(node.first_fragment, id);
      tasks.push_back({node.negative, id, Side::kNegative});
      tasks.push_back({node.positive, id, Side::kPositive});
    }
    return std::move(to_);
  }

 private:
  void copy_fragments(std::int32_t first, NodeId id) {
    if (first == kNoFragment) return;
    node_at(to_, id).first_fragment =
        static_cast<std::int32_t>(to_.fragments.size());
    for_fragments(from_, first, [&](const TreeFragment& fragment) {
      TreeFragment copy = fragment;
      copy.first_corner = static_cast<std::uint32_t>(to_.corners.size());
      for (std::uint32_t k = 0; k < fragment.corner_count; ++k)
        to_.corners.push_back(copied(from_.corners[fragment.first_corner + k]));
      copy.next = static_cast<std::int32_t>(to_.fragments.size()) + 1;
      to_.fragments.push_back(copy);
      return true;
    });
    to_.fragments.back().next = kNoFragment;
  }

  Corner copied(Corner corner) {
    if (corner.vertex < vertex_count_) return corner;
    const auto old = static_cast<std::size_t>(corner.vertex - vertex_count_);
    if (copies_[old] < 0) {
      copies_[old] = static_cast<std::int32_t>(to_.cut_vertices.size());
      to_.cut_vertices.push_back(from_.cut_vertices[old]);
    }
    corner.vertex = vertex_count_ + copies_[old];
    return corner;
  }

  const BspTree& from_;
  std::int32_t vertex_count_;
  std::vector<std::int32_t> copies_;  ///< by cut vertex
  BspTree to_;
};

/// Takes those fragments out of the lists of all nodes.
void unlink(BspTree& tree, const std::vector<bool>& gone) {
  for (Node& node : tree.nodes) {
    std::int32_t* link = &node.first_fragment;
    while (*link != kNoFragment) {
      TreeFragment& fragment = tree.fragments[static_cast<std::size_t>(*link)];
      if (gone[static_cast<std::size_t>(fragment.source)]) {
        *link = fragment.next;
      } else {
        link = &fragment.next;
      }
    }
  }
}

}  // namespace

void insert(BspTree& tree, const Scene& scene, PolygonId polygon) {
  FilterStats stats;
  insert(tree, scene, polygon, stats);
}

void insert(BspTree& tree, const Scene& scene, PolygonId polygon,
            FilterStats& stats) {
  FragmentSplitter splitter(scene, tree, stats);
  const Plane plane = plane_of(scene, polygon);
  const bool has_boxes = tree.boxes.size() == tree.nodes.size();
  std::vector<Step> steps;
  const auto start = [&](const FragmentRef& fragment, NodeId node,
                         NodeId parent, Side side) {
    const Box box = has_boxes ? box_of(tree, splitter, fragment) : Box{};
    steps.push_back({fragment, box, node, parent, side});
  };
  start(splitter.whole(polygon), tree.nodes.empty() ? kNoNode : 0, kNoNode,
        Side::kOn);
  while (!steps.empty()) {
    const Step step = steps.back();
    steps.pop_back();

    // Step 1: where there is no node, the fragment becomes one.
    if (step.node == kNoNode) {
      make_node(tree, step, plane);
      if (has_boxes) tree.boxes.push_back(step.box);
      continue;
    }
    if (has_boxes) {
      extend(tree.boxes[static_cast<std::size_t>(step.node)], step.box);
    }

    // Step 2: else it stays here, goes to one side, or is split and goes to
    // both.
    const Node node = node_at(tree, step.node);
    HALFSPACE_ASSERT(node.splitter != kNoPlane);
    const auto child = [&node](Side side) { return child_of(node, side); };
    const auto go = [&](Side side) {
      steps.push_back({step.fragment, step.box, child(side), step.node, side});
    };
    const FilterPlane filter = filter_plane(node.plane);
    switch (splitter.relation(step.fragment, node.splitter, filter)) {
      case Relation::kCoincident:
        put(tree, step.node, step.fragment, plane);
        break;
      case Relation::kPositive:
        go(Side::kPositive);
        break;
      case Relation::kNegative:
        go(Side::kNegative);
        break;
      case Relation::kSpanning: {
        const FragmentPair pair =
            splitter.split(step.fragment, node.splitter, filter);
        start(pair.negative, child(Side::kNegative), step.node,
              Side::kNegative);
        start(pair.positive, child(Side::kPositive), step.node,
              Side::kPositive);
        break;
      }
    }
  }
}

void remove(BspTree& tree, const Scene& scene,
            std::span<const PolygonId> polygons) {
  if (tree.nodes.empty()) return;
  // Step 1: the fragments leave the nodes.
  std::vector<bool> gone(scene.polygon_count());
  for (const PolygonId id : polygons) gone[static_cast<std::size_t>(id)] = true;
  unlink(tree, gone);
  // Step 2: which node takes whose place, children before their parents.
  std::vector<NodeId> order;
  std::vector<NodeId> ahead = {0};
  while (!ahead.empty()) {
    const NodeId id = ahead.back();
    ahead.pop_back();
    if (id == kNoNode) continue;
    order.push_back(id);
    ahead.push_back(node_at(tree, id).positive);
    ahead.push_back(node_at(tree, id).negative);
  }
  std::vector<NodeId> in_place_of(tree.nodes.size(), kNoNode);
  const auto standing = [&](NodeId id) {
    return id == kNoNode ? id : in_place_of[static_cast<std::size_t>(id)];
  };
  for (auto id = order.rbegin(); id != order.rend(); ++id) {
    Node& node = node_at(tree, *id);
    node.positive = standing(node.positive);
    node.negative = standing(node.negative);
    const bool has_both = node.positive != kNoNode && node.negative != kNoNode;
    in_place_of[static_cast<std::size_t>(*id)] =
        has_both || node.first_fragment != kNoFragment ? *id
        : node.positive != kNoNode                     ? node.positive
                                                       : node.negative;
  }
  // Step 3: the nodes that are left.
  const bool has_blocks = !tree.first_blocks.empty();
  tree = TreeCopy(scene, tree).copy(standing(0));
  if (has_blocks && !tree.nodes.empty()) add_blocks(tree, scene);
}

}  // namespace halfspace::fast
