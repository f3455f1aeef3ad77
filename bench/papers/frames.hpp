#pragma once

#include <vector>

#include "papers/report.hpp"
#include "papers/tree_sizes.hpp"

namespace halfspace::bench {

/// F2B fig. 12 to 14: random triangles, back to front and front to back, in
/// constant colour and interpolated, over F2B's tree (the first polygon of a
/// list is its root).
Report f2b_figures_12_to_14(const Effort& effort);

/// F2B fig. 15 and 16: the same with triangles parallel to the screen.
Report f2b_figures_15_16(const Effort& effort);

/// FAG83 table 2: frames in a second, over trees by five candidates.
Report fag83_table_2(const std::vector<Model>& models, const Effort& effort);

}  // namespace halfspace::bench
