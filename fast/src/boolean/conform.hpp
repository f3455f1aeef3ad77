#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "halfspace/fast/solid.hpp"
#include "intersect/candidates.hpp"
#include "table/shared_table.hpp"

/// Conforming meshes (JTS calls making them noding).
///
/// A solid's surface may touch itself anywhere (S6.2): with a vertex on an edge
/// or in a face, an edge across another one, along it, or in a face. It is
/// conforming if each such place is a vertex of all edges and an edge of all
/// faces there. A boolean knows of a segment only the faces of the edge that it
/// is a part of, and of a point what ends there; other contacts must be cuts.
namespace halfspace::fast {

/// Whether the solid is known to be conforming: it is marked so, or it has few
/// faces and is convex.
bool is_known_conforming(const Solid& solid);

/// Cuts an operand's edges and the intersection segments where its surface
/// touches itself on the other operand's surface. `o`: which operand.
///
/// Returns false if that is not enough: a part of an edge lies in a face that
/// does not have the edge.
/// Requires: cuts, covers and segments have been found.
bool conform_contacts(std::size_t o, std::array<Operand, 2>& operands,
                      List<IntersectionSegment>& segments,
                      GeometryTable& table);

/// The same solid, made conforming by resolving it; the faces' sources are the
/// faces that they are parts of. Open surfaces stay as they are.
/// Requires: the lease is of the solid's table.
Solid conforming(const Solid& solid, TableLease& lease);

}  // namespace halfspace::fast
