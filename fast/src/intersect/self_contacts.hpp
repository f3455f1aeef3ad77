#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "intersect/close_faces.hpp"
#include "intersect/operand.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// What the faces of one solid have in common: each two of them intersected
/// twice, as if each were of another operand. Includes cuts and covers at the
/// vertices and edges that faces share.
struct SelfContacts {
  Operand operand;
  List<IntersectionSegment> segments;  ///< each twice
};

/// Requires: the lease is of the solid's table.
SelfContacts self_contacts(const Solid& solid, TableLease& lease);

/// Those of some pairs of faces alone. The operand has the edges of these
/// faces, of `more`, and of their neighbours.
/// Requires: of the other pairs CloseFaces decides.
SelfContacts self_contacts(const Solid& solid, TableLease& lease,
                           const SurfaceEdges& edges, const FacePairs& pairs,
                           std::span<const std::int32_t> more = {});

/// Where a vertex is, rounded. Units: model units.
std::array<double, 3> place_of(const Solid& solid, std::int32_t vertex);

}  // namespace halfspace::fast
