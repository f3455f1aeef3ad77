#pragma once

#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// Fills in the tree's blocks: for each leaf, of the triangles at the beginning
/// of its list that follow each other in the array, and of the quadrangles
/// after them. With one thread it works in the caller's, and waits for none.
void add_blocks(BspTree& tree, const Scene& scene, int threads = 0);

}  // namespace halfspace::fast
