#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/fast/build.hpp"

/// Elements of trees by their indices.
namespace halfspace::fast {

inline const Node& node_at(const BspTree& tree, NodeId id) {
  return tree.nodes[static_cast<std::size_t>(id)];
}
inline Node& node_at(BspTree& tree, NodeId id) {
  return tree.nodes[static_cast<std::size_t>(id)];
}

inline const TreeFragment& fragment_at(const BspTree& tree, std::int32_t f) {
  return tree.fragments[static_cast<std::size_t>(f)];
}

/// The child of a node on a side of its splitter, for reading and writing.
inline NodeId child_of(const Node& node, Side side) {
  return side == Side::kPositive ? node.positive : node.negative;
}
inline void set_child(BspTree& tree, NodeId parent, Side side, NodeId child) {
  Node& node = node_at(tree, parent);
  (side == Side::kPositive ? node.positive : node.negative) = child;
}

/// Calls show(fragment) for a list of fragments, from the one with index
/// `first` on, while it returns true; whether it always did.
template <class Show>
bool for_fragments(const BspTree& tree, std::int32_t first, Show&& show) {
  for (std::int32_t f = first; f != kNoFragment;) {
    const TreeFragment& fragment = fragment_at(tree, f);
    if (!show(fragment)) return false;
    f = fragment.next;
  }
  return true;
}
template <class Show>
bool for_fragments(const BspTree& tree, const Node& node, Show&& show) {
  return for_fragments(tree, node.first_fragment, show);
}

}  // namespace halfspace::fast
