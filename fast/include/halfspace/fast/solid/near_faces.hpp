#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// The pairs of faces, one of each solid, whose boxes have a point in common,
/// in ascending order: all that can have one themselves. The solids may be in
/// any tables and on any grids.
///
/// Requires: `steps` is what a grid step of `b` is in steps of `a`, to within
///           2^-50 of it.
/// Cost:     n log n, and the pairs; by the search that booleans use.
std::vector<std::pair<std::int32_t, std::int32_t>> near_faces(const Solid& a,
                                                              const Solid& b,
                                                              double steps);

}  // namespace halfspace::fast
