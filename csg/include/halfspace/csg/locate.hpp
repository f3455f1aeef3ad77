#pragma once

#include "halfspace/csg/surface.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::csg {

/// -1, 0, 1: whether the point is inside, on the surface, or outside.
/// Units: grid steps. Exact. Cost: linear in the faces.
int location_of(const fast::Solid& solid, const ExactPoint& point);

}  // namespace halfspace::csg
