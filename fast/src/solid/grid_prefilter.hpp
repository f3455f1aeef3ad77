#pragma once

#include <cstdint>
#include <vector>

#include "box/box.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// Drops from two lists faces whose boxes overlap none of the other list: not
/// all of them, but most where there are many small ones. `reach` holds the
/// overlap of the two.
///
/// Without it the union and difference of two spheres of 14,160 triangles half
/// a radius apart take 7.6 % more instructions.
///
/// Cost: linear. Does nothing if many faces are large in `reach`.
void grid_prefilter(const Solid& first, std::vector<std::int32_t>& of_first,
                    const Solid& second, std::vector<std::int32_t>& of_second,
                    const Box& reach);

}  // namespace halfspace::fast
