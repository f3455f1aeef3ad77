#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "halfspace/fast/solid.hpp"
#include "intersect/candidates.hpp"
#include "table/shared_table.hpp"

/// Where a surface touches itself.
///
/// A solid's surface may do so anywhere (S6.2): a vertex on an edge or in a
/// face, an edge across another one, along it, or in a face. It is noded where
/// that is a vertex of all edges and an edge of all faces there. What a boolean
/// knows of a segment of its result are the faces of the edge that it is a part
/// of, and of a point, what ends there: of what touches them besides it has to
/// be told.
namespace halfspace::fast {

/// Whether the solid is known to be noded: it says so, or it has few faces and
/// is convex.
bool is_known_conforming(const Solid& solid);

/// Cuts an operand's edges where they lie in the other one's surface, and
/// traces, at the points of that surface at which the operand touches them.
/// False: that cannot help, as it has a face with a part of such an edge in it
/// that is not one of its own edges.
/// `o`: which operand.
/// Requires: their cuts, covers and traces have been found.
bool add_nodes(std::size_t o, std::array<Operand, 2>& operands,
               std::vector<Trace>& traces, GeometryTable& table);

/// The same solid, with an edge of all faces wherever its surface touches
/// itself along a segment; the faces' sources are the faces that they are parts
/// of. Surfaces that are open stay as they are.
/// Requires: the lease is of the solid's table.
Solid conforming(const Solid& solid, TableLease& lease);

}  // namespace halfspace::fast
