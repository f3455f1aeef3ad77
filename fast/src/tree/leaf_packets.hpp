#pragma once

#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// Fills in the tree's blocks: for each leaf, of the triangles at the beginning
/// of its list that follow each other in the array, and of the quadrangles
/// after them.
void add_blocks(BspTree& tree, const Scene& scene);

}  // namespace halfspace::fast
