#pragma once

#include "halfspace/fast/bad_edges.hpp"
#include "halfspace/fast/self_intersections.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/result.hpp"

namespace halfspace::fast {

/// Whether a solid is one that booleans are right about (S6.1, S6.2): closed,
/// edge by edge and face by face, with a surface that does not cross itself and
/// winds round points once or not at all.
///
/// Exact:   yes.
/// Errors:  kOpen, kSelfCrossing (also where it winds round a point twice),
///          kInsideOut; with the number of the first face. The message names
///          the polygons that the faces come from, and the place in model
///          units, rounded for people to read. kStopped (the progress did).
/// Threads: any.
/// Cost:    n log n, and little more than that of finding faces whose boxes
///          overlap: two that have a corner in common are settled by a few
///          signs. A search for each connected part of the surface.
Result<Done> check_operand(const Solid& solid,
                           const CheckOptions& options = {});

}  // namespace halfspace::fast
