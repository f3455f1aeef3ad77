#pragma once

#include "halfspace/boolean.hpp"
#include "halfspace/result.hpp"

namespace halfspace::tools {

/// Whether no two polygons of the solid cross or overlap (S6.2).
/// Errors: kNotClosed: how many pairs do, which is the first, and where; index
///         is its first polygon.
Result<Done> without_crossings(const Solid& solid);

}  // namespace halfspace::tools
