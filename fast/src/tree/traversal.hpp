#pragma once

#include <vector>

#include "tree/eye_classifier.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {

/// Walks the tree (S3.7; F2B figs. 5, 6), kNearFirst: near subtree, node, far
/// subtree; else far subtree, node, near subtree. Positive counts as near for
/// an eye on the splitter (E2).
///
/// reach(node, sign, side) says whether the child on that side can be seen past
/// the node's splitter; enter(id) whether the subtree is worth it. show(node,
/// sign) displays a node's fragments, `sign` being the eye's side, 0 for a
/// leaf, and says whether to go on. The papers recurse; a stack works at any
/// depth.
template <bool kNearFirst, class Reach, class Enter, class Show>
void walk(const BspTree& tree, const EyeClassifier& side_of_eye, Reach&& reach,
          Enter&& enter, Show&& show) {
  struct Step {
    NodeId node;  ///< to be shown, and then its second subtree walked
    int sign;
  };
  std::vector<Step> steps;
  const auto child = [&](const Node& node, int sign, bool positive) {
    const NodeId id = positive ? node.positive : node.negative;
    return id != kNoNode && reach(node, sign, positive ? 1 : -1) ? id : kNoNode;
  };
  NodeId next = tree.nodes.empty() ? kNoNode : 0;
  while (true) {
    while (next != kNoNode && enter(next)) {
      const Node& node = node_at(tree, next);
      if (node.splitter == kNoPlane) {
        if (!show(node, 0)) return;
        break;
      }
      const int sign = side_of_eye(node.plane, node.splitter);
      steps.push_back({next, sign});
      next = child(node, sign, (sign < 0) != kNearFirst);
    }
    if (steps.empty()) return;
    const Step step = steps.back();
    steps.pop_back();
    const Node& node = node_at(tree, step.node);
    // Polygons in a plane that holds the eye are invisible.
    if (step.sign != 0 && !show(node, step.sign)) return;
    next = child(node, step.sign, (step.sign < 0) == kNearFirst);
  }
}

/// Every subtree is worth it.
struct EnterAll {
  bool operator()(NodeId) const { return true; }
};

/// Every side can be seen.
struct ReachAll {
  bool operator()(const Node&, int, int) const { return true; }
};

template <class Enter, class Show, class Reach = ReachAll>
void walk_front_to_back(const BspTree& tree, const EyeClassifier& side_of_eye,
                        Enter&& enter, Show&& show, Reach&& reach = {}) {
  walk<true>(tree, side_of_eye, reach, enter, show);
}
template <class Enter, class Show, class Reach = ReachAll>
void walk_back_to_front(const BspTree& tree, const EyeClassifier& side_of_eye,
                        Enter&& enter, Show&& show, Reach&& reach = {}) {
  walk<false>(tree, side_of_eye, reach, enter, show);
}

/// for_fragments() from the list's end. `scratch` is room for their indices.
template <class Show>
bool for_fragments_reversed(const BspTree& tree, const Node& node,
                            std::vector<std::int32_t>& scratch, Show&& show) {
  scratch.clear();
  for (std::int32_t f = node.first_fragment; f != kNoFragment;) {
    scratch.push_back(f);
    f = fragment_at(tree, f).next;
  }
  for (auto it = scratch.rbegin(); it != scratch.rend(); ++it) {
    if (!show(fragment_at(tree, *it))) return false;
  }
  return true;
}

}  // namespace halfspace::fast
