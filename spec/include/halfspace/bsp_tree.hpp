#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/polygon.hpp"
#include "halfspace/splitmix.hpp"

namespace halfspace {

/// How the root of each subtree is chosen (S3.3). Ties: the lowest polygon id.
enum class RootRule : std::uint8_t {
  kFirst,       ///< the first polygon of the list (F2B)
  kRandom,      ///< of `candidates` drawn ones, fewest cuts (FAG83 sec. 3.1)
  kFewestCuts,  ///< of all, fewest cuts (FAG83 sec. 3.1)
  kH1,          ///< HEUR H-1: least out-degree
  kH2,          ///< HEUR H-2: greatest in-degree
  kH3,          ///< HEUR H-3: least out-degree, then greatest in-degree
  kH4,          ///< HEUR H-4: least |IN - OUT|
  kH5,          ///< HEUR H-5: least out-degree * |IN - OUT|
  kH6,          ///< HEUR H-6: least cut_weight * out-degree + |IN - OUT|
};

/// Everything a tree depends on beside the scene (S3.3).
struct BuildOptions {
  RootRule rule = RootRule::kRandom;
  std::uint32_t candidates = 5;   ///< for kRandom; at least 1
  std::uint64_t seed = 1;         ///< for kRandom
  std::uint32_t cut_weight = 75;  ///< for kH6; HEUR's S, 50 to 100 there
  friend bool operator==(const BuildOptions&, const BuildOptions&) = default;
};

/// Index of a node in its tree.
using NodeId = std::int32_t;

/// The child that is not there.
constexpr NodeId kNoNode = -1;

/// The name of a tree node (S3.1).
struct NodeName {
  PolygonId splitter = 0;                ///< the polygon whose plane it holds
  std::vector<FragmentName> coincident;  ///< in id order
  NodeId positive = kNoNode;
  NodeId negative = kNoNode;
  friend bool operator==(const NodeName&, const NodeName&) = default;
};

/// A tree by names alone, for comparing trees: its nodes in the order node,
/// positive subtree, negative subtree.
using TreeName = std::vector<NodeName>;

/// The size of a tree (S3.2).
struct TreeStats {
  std::size_t nodes = 0;      ///< HEUR's number of nodes
  std::size_t height = 0;     ///< nodes on the longest way down; 0 if empty
  std::size_t fragments = 0;  ///< FAG83's number of polygons in the tree
  std::size_t splits = 0;     ///< fragments - polygons
  friend bool operator==(const TreeStats&, const TreeStats&) = default;
};

/// The state of the draw at a node, and the draws themselves (S3.4).
///
/// mix() is a step of splitmix64 (splitmix.hpp).
/// The key of the root, and of the children of a node with key `key` (S3.4).
constexpr std::uint64_t root_key(std::uint64_t seed) { return mix(seed); }
constexpr std::uint64_t positive_key(std::uint64_t key) { return mix(key + 1); }
constexpr std::uint64_t negative_key(std::uint64_t key) { return mix(key + 2); }

/// Draw number `draw` at the node with key `key`: 0 to `count` - 1 (S3.4).
/// Requires: count > 0.
constexpr std::uint64_t draw(std::uint64_t key, std::uint64_t number,
                             std::uint64_t count) {
  return mix(key + 3 + number) % count;
}

}  // namespace halfspace
