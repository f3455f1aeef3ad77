#pragma once

#include <vector>

#include "halfspace/fast/self_intersections.hpp"
#include "intersect/candidates.hpp"

namespace halfspace::fast {

/// What the faces of one solid have in common: every two of them met twice, as
/// if each were of another operand. Cuts and covers include those at the
/// vertices and edges that faces share by right.
struct SelfContacts {
  Operand operand;
  std::vector<Trace> traces;  ///< each twice
};

SelfContacts self_contacts(const Solid& solid);

std::vector<SelfIntersection> self_intersections_of(
    const SelfContacts& contacts);

}  // namespace halfspace::fast
