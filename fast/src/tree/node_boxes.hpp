#pragma once

#include "camera/view.hpp"
#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// Fills in the tree's boxes.
/// Requires: children have greater indices than their parents, as in every
///           tree built or extended here.
void add_boxes(BspTree& tree, const Scene& scene);

/// Bounds the coordinates of all that is in the tree: by the box of its root,
/// if it has boxes, else by the grid. A scene that takes little of its grid
/// has the smaller errors for it.
Extent extent_of(const BspTree& tree, int grid_bits);

}  // namespace halfspace::fast
