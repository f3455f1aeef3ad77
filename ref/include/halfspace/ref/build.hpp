#pragma once

#include <span>
#include <vector>

#include "halfspace/bsp_tree.hpp"
#include "halfspace/ref/predicate.hpp"

namespace halfspace::ref {

/// A node of a tree: a plane, and the fragments in it (S3.1).
struct Node {
  PolygonId splitter = 0;            ///< the polygon whose plane it is
  Plane plane;                       ///< that plane, with its orientation
  std::vector<Fragment> coincident;  ///< in id order, either orientation
  NodeId positive = kNoNode;
  NodeId negative = kNoNode;
};

/// A tree; its root, if it has one, is the first node (S3.1).
struct BspTree {
  std::vector<Node> nodes;
};

/// The tree of the scene (S3.5; FAG83 sec. 2.2.1, Make_tree).
///
/// A pure function of its arguments; no recursion.
/// Requires: options.candidates >= 1.
BspTree build(const Scene& scene, const BuildOptions& options);

/// The tree of `polygons`, in id order, polygon `f.source` lying in plane
/// `planes[f.source]` (S3.5). build(scene, options) is this for the scene's
/// polygons and their planes.
BspTree build(const std::vector<Plane>& planes, std::vector<Fragment> polygons,
              const BuildOptions& options);

/// Adds a polygon, lying in `plane`, to a tree (S3.6; F2B "on-line").
///
/// Each part of it ends in the node whose plane it lies in, or in a new node
/// of its own where there was none.
void insert(BspTree& tree, Fragment polygon, const Plane& plane);

/// Takes polygons out of a tree (S3.11). Nodes are numbered anew: node,
/// positive subtree, negative subtree.
void remove(BspTree& tree, std::span<const PolygonId> polygons);

/// The size of the tree (S3.2). No recursion.
TreeStats stats(const BspTree& tree);

/// The tree by names alone (S3.1). No recursion.
TreeName name_of(const BspTree& tree);

}  // namespace halfspace::ref
