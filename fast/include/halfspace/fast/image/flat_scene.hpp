#pragma once

#include "halfspace/moving.hpp"

namespace halfspace::fast {

/// The moved polygons as a scene of their own (S12.7): the image of it by any
/// means is that of render_moving().
///
/// Requires: regions that are free (build_moving_trees()).
/// Errors:   kOutOfRange: a grid of 54 bits does not hold the corners, or the
///           camera.
/// Exact:    yes.
/// Cost:     linear in the polygons of all occurrences, which are held anew;
///           vertices that polygons of a model share, they share here.
Result<FlatScene> flat_scene(const Assembly& assembly,
                             const Placement& placement, const Camera& camera);

}  // namespace halfspace::fast
