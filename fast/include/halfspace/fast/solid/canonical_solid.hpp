#pragma once

#include <optional>

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// The same solid in a table of its own, everything in it in an order that
/// depends on nothing but its faces as regions, and on where they come from:
/// vertices by their coordinates; faces by origin, and by their vertices; loops
/// from their first vertex on. So what is made of it does not depend on how it
/// was made: of booleans in one run, or of a file that was written on the way.
///
/// Half-spaces and other unbounded solids are left as they are.
/// Exact: yes. Cost: linear, and a sort of the vertices.
Solid canonical(const Solid& solid);

/// The same with what a file shows besides: the solid's own unit, and so the
/// points of its table: the coarsest of at most 1 with which the planes of all
/// faces have points on the grid, and finer if vertices have to be points (F7).
/// Where more than three planes meet in a vertex it is named by the first three
/// that do; an edge names the first plane of another face there; and a plane
/// the first point of the grid that is a vertex on it, if there is one, and
/// else the one that is nearest to the origin.
///
/// Exact: yes. Cost: linear, and a sort of the edges.
Solid canonical_for_file(const Solid& solid);

/// The same solid on a grid of 54 bits that has all of its vertices as points,
/// if some grid has, of the coarsest unit of at most 1.
///
/// Requires: it is bounded, and has a face.
/// Exact: yes. Cost: where the first vertex that is on no grid here is on none,
///        as nearly always, next to nothing.
std::optional<Solid> on_points(const Solid& solid);

}  // namespace halfspace::fast
