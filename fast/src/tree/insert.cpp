#include <vector>

#include "box/box.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/build.hpp"
#include "tree/fragment_splitter.hpp"
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

}  // namespace halfspace::fast
