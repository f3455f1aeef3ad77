#pragma once

#include "halfspace/fast/render.hpp"
#include "raster/frame.hpp"

namespace halfspace::fast {

/// Puts the caps of the frame's clip planes into a rendering of the clipped
/// scene (S10.3): of the rectangle, items and maybe colours.
///
/// Only polygons that cross a clip plane are looked at: row by row they say
/// where the winding number in the plane changes.
/// Requires: a closed scene; image.caps; result.items of the rectangle.
/// Exact:    yes.
/// Cost:     the way through the tree to what crosses the planes, one exact
///           function for each of them and row, and what is filled.
void add_caps(const Frame& frame, const Rectangle& rectangle,
              Rendering& result);

}  // namespace halfspace::fast
