#pragma once

#include <functional>

#include "halfspace/camera.hpp"
#include "halfspace/ref/build.hpp"

namespace halfspace::ref {

/// Called for each fragment; false ends the traversal.
using Visitor = std::function<bool(const Node&, const Fragment&)>;

/// Displays the fragments of the tree so that none is hidden by one displayed
/// before it (S3.7; F2B fig. 5, FAG83 Traverse_tree; E2).
///
/// Far subtree, node, near subtree. On the eye's side of a splitter that holds
/// the eye, positive counts as near; that node's own fragments are invisible
/// and are not displayed.
/// Ties: fragments of one node, highest id first.
void back_to_front(const BspTree& tree, const Camera& camera,
                   const Visitor& visit);

/// Displays the fragments of the tree so that none hides one displayed before
/// it (S3.7; F2B fig. 6): near subtree, node, far subtree.
///
/// Ties: fragments of one node, lowest id first.
void front_to_back(const BspTree& tree, const Camera& camera,
                   const Visitor& visit);

}  // namespace halfspace::ref
