#pragma once

#include <vector>

#include "drawing/hiding.hpp"

namespace halfspace::fast {

/// The intersections of a scene's polygons (S9.3), in the order of their
/// polygons. `present`: by polygon whether it takes part.
std::vector<Line> crossings(Sight& sight, const SceneEdges& edges,
                            const std::vector<bool>& present);

}  // namespace halfspace::fast
