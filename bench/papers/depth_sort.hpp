#pragma once

#include <vector>

#include "papers/report.hpp"
#include "papers/tree_sizes.hpp"

namespace halfspace::bench {

/// F2B's conclusion: depth sort (S3.9; NNS72) feeds span merging and painting,
/// beside the BSP tree by F2B's rule, on F2B's triangles and FAG83's models.
Report f2b_depth_sort(const std::vector<Model>& models, const Effort& effort);

}  // namespace halfspace::bench
