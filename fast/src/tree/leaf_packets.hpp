#pragma once

#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// Fills in the tree's blocks: of each leaf those of the triangles that its
/// list begins with, as far as they follow each other in the array, and of the
/// quadrangles after them.
void add_blocks(BspTree& tree, const Scene& scene);

}  // namespace halfspace::fast
