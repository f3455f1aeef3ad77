#pragma once

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// The same solid in a table of its own, everything in it in an order that
/// depends on nothing but its faces as regions, and on where they come from:
/// vertices by their coordinates; faces by origin, and by their vertices; loops
/// from their first vertex on. So what is made of it does not depend on how it
/// was made: of booleans in one run, or of a file that was written on the way.
///
/// With `names`: where more than three planes meet in a vertex it is named by
/// the first three that do; an edge names the first plane of another face
/// there; and a plane the first point of the grid that is a vertex on it, if
/// there is one, and else a point that its place in space decides: of the
/// coarsest grid, of powers of the unit's base, that has points on it, the
/// nearest to the origin.
/// Nothing but a file of an exact solid shows these.
///
/// Half-spaces and other unbounded solids are left as they are.
/// Exact: yes. Cost: linear, and a sort of the edges.
Solid canonical(const Solid& solid, bool names);

}  // namespace halfspace::fast
