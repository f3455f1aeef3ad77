#pragma once

#include <optional>
#include <span>

#include "drawing/hiding.hpp"
#include "halfspace/drawing.hpp"
#include "halfspace/fast/predicate.hpp"

namespace halfspace::fast {

/// The class of an edge by the polygons at it (S9.2); nothing if it is not
/// drawn.
std::optional<EdgeClass> class_of(std::span<const EdgeSide> sides,
                                  const Sight& sight, const Hiding& hiding,
                                  const PlaneTable& planes,
                                  const DrawingOptions& options);

}  // namespace halfspace::fast
