#include "halfspace/ref/traverse.hpp"

#include <vector>

namespace halfspace::ref {
namespace {

/// A step still to be done: a whole subtree, or a node's own fragments.
struct Step {
  enum class Kind { kSubtree, kNode };
  Kind kind;
  NodeId node;  ///< kNoNode: the empty subtree
};

/// The children of a node by where the eye is (F2B). Where it is on the
/// splitter, either order is right, and positive counts as near.
struct Children {
  NodeId near;
  NodeId far;
};

Children children_of(const Node& node, Side eye) {
  if (eye == Side::kNegative) return {node.negative, node.positive};
  return {node.positive, node.negative};
}

}  // namespace

void back_to_front(const BspTree& tree, const Camera& camera,
                   const Visitor& visit) {
  using enum Step::Kind;
  // The papers recurse; a stack, last in first out, does so at any depth.
  std::vector<Step> steps;
  if (!tree.nodes.empty()) steps.push_back({kSubtree, 0});
  while (!steps.empty()) {
    const Step step = steps.back();
    steps.pop_back();
    if (step.node == kNoNode) continue;
    const Node& node = tree.nodes[static_cast<std::size_t>(step.node)];
    if (step.kind == kNode) {
      for (auto it = node.coincident.rbegin(); it != node.coincident.rend();
           ++it) {
        if (!visit(node, *it)) return;
      }
      continue;
    }
    const Side eye = side_of_eye(node.plane, camera);
    const Children children = children_of(node, eye);
    // Step 3: the near side.
    steps.push_back({kSubtree, children.near});
    // Step 2: the node; the eye on its plane sees nothing of it.
    if (eye != Side::kOn) steps.push_back({kNode, step.node});
    // Step 1: the far side, pushed last and so done first.
    steps.push_back({kSubtree, children.far});
  }
}

void front_to_back(const BspTree& tree, const Camera& camera,
                   const Visitor& visit) {
  using enum Step::Kind;
  std::vector<Step> steps;
  if (!tree.nodes.empty()) steps.push_back({kSubtree, 0});
  while (!steps.empty()) {
    const Step step = steps.back();
    steps.pop_back();
    if (step.node == kNoNode) continue;
    const Node& node = tree.nodes[static_cast<std::size_t>(step.node)];
    if (step.kind == kNode) {
      for (const Fragment& fragment : node.coincident) {
        if (!visit(node, fragment)) return;
      }
      continue;
    }
    const Side eye = side_of_eye(node.plane, camera);
    const Children children = children_of(node, eye);
    // Step 3: the far side.
    steps.push_back({kSubtree, children.far});
    // Step 2: the node; the eye on its plane sees nothing of it.
    if (eye != Side::kOn) steps.push_back({kNode, step.node});
    // Step 1: the near side, pushed last and so done first.
    steps.push_back({kSubtree, children.near});
  }
}

}  // namespace halfspace::ref
