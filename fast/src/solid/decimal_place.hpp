#pragma once

#include <array>
#include <cstdint>

#include "table/geometry_table.hpp"

namespace halfspace::fast {

/// The coordinates of a vertex divided by 10^digits, as the nearest doubles,
/// ties to even: each is rounded once, so they are those of the point in model
/// units, whatever the grid's unit is. Sets `is_rounded` if one is not exact.
///
/// Requires: 0 <= digits <= kMostDigits.
constexpr int kMostDigits = 22;  // 10^22 is a double
std::array<double, 3> decimal_place(const GeometryTable& table,
                                    std::int32_t vertex, int digits,
                                    bool& is_rounded);

}  // namespace halfspace::fast
