#pragma once

#include <array>
#include <span>

#include "halfspace/io/import.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace::io {

/// A direction, of any length.
using Direction = std::array<double, 3>;

/// Twice the area of a polygon times its normal, in doubles.
Direction normal_of(std::span<const GridPoint> corners);

/// The colour of a surface that faces this way, as the options light it. The
/// same on every machine: IEEE operations only.
Rgb lit(const Rgb& surface, const Direction& normal,
        const ImportOptions& options);

}  // namespace halfspace::io
