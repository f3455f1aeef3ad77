#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/polygon.hpp"

namespace halfspace::io {

/// What a closed chain of points is, as a polygon.
enum class Shape : std::uint8_t {
  kNoArea,  ///< fewer than 3 points, or all on one line
  kConvex,  ///< a valid polygon (S1.3)
  kOther,   ///< not planar, not convex, or a point is visited twice
};

/// The shape of a polygon.
/// Requires: no corner repeats the one before it, cyclically.
/// Exact:    yes, for any grid.
Shape shape_of(std::span<const GridPoint> corners);

/// The most corners of a polygon that is cut into triangles.
constexpr std::size_t kMaxEarCorners = 100000;

/// Cuts a polygon into triangles, given as indices of its corners.
///
/// Ears are clipped in the projection along the axis in which the polygon's
/// area is greatest. For a weakly simple polygon in a plane (its boundary may
/// touch itself, or run to a hole and back on a bridge) the triangles tile it;
/// for any other they are some. None is without area. Over all of them, edges
/// sum up to the polygon's, but for the corner of a spike that had to go.
/// The fattest ears go first: where rounding has bent a side of many corners,
/// thin ones would fold over.
///
/// Requires: as shape_of(), and at most kMaxEarCorners.
/// Exact:    yes: signs of 2-by-2 determinants, of at most 112 bits.
/// Ties:     of ears of about one height the first that was found, in the
///           corners' order.
/// Cost:     n log n for n corners where what is near an ear is near it in the
///           corners' order, too; quadratic at worst, whatever the polygon.
std::vector<std::array<std::size_t, 3>> triangulate(
    std::span<const GridPoint> corners);

}  // namespace halfspace::io
