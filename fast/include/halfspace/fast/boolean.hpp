#pragma once

#include "halfspace/boolean.hpp"
#include "halfspace/fast/bad_edges.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// The regularised boolean of two solids in one unit (S6.4, S6.5).
///
/// The same point set as the reference's result. Either operand may be empty,
/// and a default one fits any unit.
///
/// Shape:   the first operand's faces come first. Those that the other operand
///          does not touch are unchanged. The others have no more edges than
///          the point set needs: no vertex at which the boundary goes straight
///          on, no edge within a face, and every vertex on an edge is an end of
///          it. The last of these needs conforming operands. One that does not
///          conform is made to near the other operand; if an edge runs through
///          one of its faces there, all of it is resolved first, as by
///          resolve().
/// Keeps:   planes and colours, and where faces came from.
/// Exact:   yes. Of closed surfaces that check_operand() refuses the result may
///          be anything, and open, but there is one.
/// Threads: any thread may use any solids at any time. `threads` look for the
///          places where the solids meet (0: as many as the machine has); the
///          result is the same. While another
///          thread extends the operands' table the result has a table of its
///          own, with other ids: its mesh is the same.
/// Cost:    n log n, and what the surfaces have in common.
Solid boolean(BooleanOp operation, const Solid& a, const Solid& b,
              int threads = 1);

}  // namespace halfspace::fast
