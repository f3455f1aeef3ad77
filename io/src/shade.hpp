#pragma once

#include <array>
#include <span>

#include "halfspace/polygon.hpp"

namespace halfspace::io {

/// A direction, of any length.
using Direction = std::array<double, 3>;

/// Twice the area of a polygon times its normal, in doubles.
Direction normal_of(std::span<const GridPoint> corners);

/// The colour of a surface that faces this way, in a fixed light from above,
/// the left and the front. The same on every machine: IEEE operations only.
Rgb shaded(const Direction& normal);

}  // namespace halfspace::io
