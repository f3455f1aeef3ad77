#pragma once

#include <cstdint>
#include <optional>

#include "exact/big_rational.hpp"
#include "exact/exact_plane.hpp"
#include "halfspace/int128.hpp"
#include "table/geometry_table.hpp"

namespace halfspace::fast {

/// A plane that is in no table: normal . x = offset / below, in steps of a
/// solid's unit. The normal's components have no common divisor, the first that
/// is not 0 is positive, and so is `below`; neither have these two one.
struct LinePlane {
  Vector3<Int128> normal;
  BigInteger offset, below;
  std::int32_t face = 0, instead = 0;  ///< the planes through whose line it is
};

/// The plane through the line in which two planes meet, along the axis that is
/// the farthest from the first (F7): which it is depends on the line and the
/// first plane alone. Nothing where its normal has a component of 2^53 or more.
///
/// Requires: the planes meet in a line. Exact: yes.
std::optional<LinePlane> line_plane_of(const GeometryTable& table,
                                       std::int32_t face, std::int32_t other);

}  // namespace halfspace::fast
