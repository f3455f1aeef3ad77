#pragma once

#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// Fills in the tree's boxes.
/// Requires: children have greater indices than their parents, as in every
///           tree built or extended here.
void add_boxes(BspTree& tree, const Scene& scene);

}  // namespace halfspace::fast
