#pragma once

#include <cstdint>
#include <span>

#include "camera/view.hpp"
#include "raster/exact_coverage.hpp"

namespace halfspace::fast {

/// A function of the image that is larger where the fragment is nearer, at the
/// centres of the pixels (i, j) that it covers. `farthest` bounds i and j.
/// Where doubles do not suffice its error is enormous, or no number.
///
/// It comes from the vertices that the fragment is drawn by, not from its
/// plane.
DepthDifference depth_of(std::span<const Vertex> corners, const View& view,
                         std::int32_t farthest);

}  // namespace halfspace::fast
