#pragma once

#include "halfspace/fast/self_intersections.hpp"
#include "intersect/self_contacts.hpp"

namespace halfspace::fast {

/// As self_intersections(), of a surface whose contacts are known.
std::vector<SelfIntersection> self_intersections_of(
    const SelfContacts& contacts);

}  // namespace halfspace::fast
