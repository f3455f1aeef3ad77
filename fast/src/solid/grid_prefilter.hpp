#pragma once

#include <cstdint>
#include <vector>

#include "box/box.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// Drops faces whose boxes overlap none of the other list's from two lists of
/// faces, in their order: not all of them, but most where there are many small
/// ones. `reach` holds what overlaps of the two.
///
/// Cost: linear. Faces that are large in it are not worth it: nothing is done.
void drop_lonely(const Solid& first, std::vector<std::int32_t>& of_first,
                 const Solid& second, std::vector<std::int32_t>& of_second,
                 const Box& reach);

}  // namespace halfspace::fast
