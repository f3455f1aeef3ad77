#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "halfspace/fast/solid.hpp"

namespace halfspace::identities {

/// An edge of the surface's region in a plane that faces one way: the plane,
/// whether outwards is against its normal, from where and to where.
using Bound = std::tuple<std::int32_t, bool, std::int32_t, std::int32_t>;

/// The edges of the least surface in order, without those at which one region
/// meets itself.
std::vector<Bound> bounds_of(const fast::Solid& solid);

}  // namespace halfspace::identities
