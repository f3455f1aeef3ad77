#pragma once

#include <cstdint>
#include <span>

#include "camera/view.hpp"
#include "raster/exact_coverage.hpp"

namespace halfspace::fast {

/// How near a fragment is: at the centre of a pixel (i, j) that it covers,
/// larger where nearer. `farthest` bounds i and j. Where doubles cannot tell it
/// the error is enormous, or no number.
///
/// Unlike its plane that comes from the vertices that it is drawn by.
DepthDifference depth_of(std::span<const Vertex> corners, const View& view,
                         std::int32_t farthest);

}  // namespace halfspace::fast
