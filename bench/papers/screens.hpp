#pragma once

#include "papers/report.hpp"
#include "papers/tree_sizes.hpp"

namespace halfspace::bench {

/// FAQ: screens of four kinds (S4.9) on random triangles, by their size, their
/// number and the resolution; the usual screen of tiles beside them.
Report faq_screens(const Effort& effort);

}  // namespace halfspace::bench
