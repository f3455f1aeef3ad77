#pragma once

#include <array>
#include <cstdint>

#include "halfspace/polygon.hpp"

namespace halfspace::fast {

/// Signs of determinants of grid points. All are exact for coordinates of up to
/// 55 bits.

/// Twice the area of a triangle, as a vector, is zero.
bool on_one_line(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// The sign of (b - a) x (c - a) . (d - a): positive where a, b, c are seen
/// counterclockwise from d.
int side_of_triangle(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                     const GridPoint& d);

/// Whether the points are all on one side of a triangle's plane, none in it.
bool on_one_side(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                 const std::array<const GridPoint*, 3>& points);

/// Bits for the axes along which a component of (b - a) x (c - a) is positive,
/// or negative, beyond doubt.
struct NormalSigns {
  std::uint8_t positive = 0;
  std::uint8_t negative = 0;
};
NormalSigns normal_signs(const GridPoint& a, const GridPoint& b,
                         const GridPoint& c);

/// The sign of the component of (b - a) x (c - a) along an axis.
int turn_along(int axis, const GridPoint& a, const GridPoint& b,
               const GridPoint& c);

/// Whether a segment and a triangle have a point in common.
/// Requires: the triangle has an area, the segment a length.
bool meets_triangle(const GridPoint& p, const GridPoint& q, const GridPoint& a,
                    const GridPoint& b, const GridPoint& c);

}  // namespace halfspace::fast
