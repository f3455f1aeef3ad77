#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "tree/autopartition.hpp"

namespace halfspace::fast {

/// How the fragments of a leaf are divided.
constexpr BuildOptions kLeafOptions = {.rule = RootRule::kRandom,
                                       .candidates = 5};
constexpr std::uint64_t leaf_seed(NodeId leaf) {
  return kLeafOptions.seed + static_cast<std::uint64_t>(leaf);
}

/// The fragments of a leaf, the lowest ids first.
void fragments_of_leaf(const BspTree& tree, const Node& leaf,
                       std::vector<FragmentRef>& fragments);

/// Divides leaves of a tree when a walk comes to them: each becomes a tree of
/// its own for as long as the walk is there, the one that divide_leaves() makes
/// of it.
class LeafDivider {
 public:
  /// Requires: both outlive it.
  LeafDivider(const Scene& scene, const BspTree& tree, FilterStats& stats);
  LeafDivider(const LeafDivider&) = delete;
  LeafDivider& operator=(const LeafDivider&) = delete;

  /// The tree of a leaf's fragments, until the next call. Its planes and
  /// vertices have the names that they have in the whole tree, but for the
  /// vertices of cuts.
  const BspTree& divide(const Node& leaf);
  /// That of the last leaf.
  const BspTree& part() const { return part_; }

 private:
  FragmentRef copy_of(const FragmentRef& fragment);

  const BspTree& tree_;
  std::int32_t vertex_count_;
  BspTree part_;
  Autopartition<PlanesByNeed> partition_;
  std::vector<FragmentRef> fragments_;
};

}  // namespace halfspace::fast
