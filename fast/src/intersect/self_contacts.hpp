#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/fast/self_intersections.hpp"
#include "intersect/candidates.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// What the faces of one solid have in common: every two of them met twice, as
/// if each were of another operand. Cuts and covers include those at the
/// vertices and edges that faces share by right.
struct SelfContacts {
  Operand operand;
  std::vector<Trace> traces;  ///< each twice
};

/// Requires: the lease is of the solid's table.
SelfContacts self_contacts(const Solid& solid, TableLease& lease);

/// Where a vertex is, rounded. Units: model units.
std::array<double, 3> place_of(const Solid& solid, std::int32_t vertex);

std::vector<SelfIntersection> self_intersections_of(
    const SelfContacts& contacts);

}  // namespace halfspace::fast
