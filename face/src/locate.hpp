#pragma once

#include "halfspace/fast/solid.hpp"
#include "halfspace/solid.hpp"

namespace halfspace::detail {

/// Where a point is against a bounded solid. Exact.
/// Source: the winding number of S6.2, by the faces that a ray meets.
Location location_of(const fast::Solid& solid, const Point& point);

}  // namespace halfspace::detail
