#pragma once

#include <utility>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "tree/eye_classifier.hpp"

namespace halfspace::fast {

/// Walks the tree front to back: near subtree, node, far subtree.
///
/// enter(id) says whether the subtree is worth it; show(node, sign) displays a
/// node's fragments, sign being the eye's side, 0 for a leaf, and says whether
/// to go on. The papers recurse; a stack does so at any depth.
template <class Enter, class Show>
void walk_front_to_back(const BspTree& tree, const EyeClassifier& side_of_eye,
                        Enter&& enter, Show&& show) {
  struct Step {
    NodeId node;  ///< to be shown, and then its far subtree walked
    int sign;
  };
  std::vector<Step> steps;
  NodeId next = tree.nodes.empty() ? kNoNode : 0;
  while (true) {
    while (next != kNoNode && enter(next)) {
      const Node& node = tree.nodes[static_cast<std::size_t>(next)];
      if (node.splitter == kNoPlane) {
        if (!show(node, 0)) return;
        break;
      }
      const int sign = side_of_eye(node.plane, node.splitter);
      steps.push_back({next, sign});
      next = sign < 0 ? node.negative : node.positive;
    }
    if (steps.empty()) return;
    const Step step = steps.back();
    steps.pop_back();
    const Node& node = tree.nodes[static_cast<std::size_t>(step.node)];
    // The eye on a node's plane sees nothing of it.
    if (step.sign != 0 && !show(node, step.sign)) return;
    next = step.sign < 0 ? node.positive : node.negative;
  }
}

/// The same back to front: far subtree, node, near subtree.
template <class Show>
void walk_back_to_front(const BspTree& tree, const EyeClassifier& side_of_eye,
                        Show&& show) {
  struct Step {
    NodeId node;
    int sign;
  };
  std::vector<Step> steps;
  NodeId next = tree.nodes.empty() ? kNoNode : 0;
  while (true) {
    while (next != kNoNode) {
      const Node& node = tree.nodes[static_cast<std::size_t>(next)];
      const int sign = side_of_eye(node.plane, node.splitter);
      steps.push_back({next, sign});
      next = sign < 0 ? node.positive : node.negative;
    }
    if (steps.empty()) return;
    const Step step = steps.back();
    steps.pop_back();
    const Node& node = tree.nodes[static_cast<std::size_t>(step.node)];
    if (step.sign != 0 && !show(node, step.sign)) return;
    next = step.sign < 0 ? node.negative : node.positive;
  }
}

/// Calls show(fragment) for a list of fragments while it returns true: lowest
/// id first, but in leaves, where order does not matter.
template <class Show>
bool for_fragments(const BspTree& tree, std::int32_t first, Show&& show) {
  for (std::int32_t f = first; f != kNoFragment;) {
    const TreeFragment& fragment = tree.fragments[static_cast<std::size_t>(f)];
    if (!show(fragment)) return false;
    f = fragment.next;
  }
  return true;
}
template <class Show>
bool for_fragments(const BspTree& tree, const Node& node, Show&& show) {
  return for_fragments(tree, node.first_fragment, show);
}

/// The same from the list's end. `scratch` is room for their indices.
template <class Show>
bool for_fragments_reversed(const BspTree& tree, const Node& node,
                            std::vector<std::int32_t>& scratch, Show&& show) {
  scratch.clear();
  for (std::int32_t f = node.first_fragment; f != kNoFragment;) {
    scratch.push_back(f);
    f = tree.fragments[static_cast<std::size_t>(f)].next;
  }
  for (auto it = scratch.rbegin(); it != scratch.rend(); ++it) {
    if (!show(tree.fragments[static_cast<std::size_t>(*it)])) return false;
  }
  return true;
}

}  // namespace halfspace::fast
