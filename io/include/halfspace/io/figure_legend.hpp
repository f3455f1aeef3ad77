#pragma once

#include "halfspace/io/figure.hpp"
#include "halfspace/io/legend.hpp"

namespace halfspace::io {

/// Adds a legend at the right side of a figure, where draw_legend() would draw
/// it in a picture of this size: a region a colour, strokes and texts.
///
/// Returns false, and adds nothing, where the figure is too small for it.
/// Requires: a figure in pixels.
bool add_legend(const Legend& legend, const Rgb& background, Figure& figure);

}  // namespace halfspace::io
