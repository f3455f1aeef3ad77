#pragma once

#include <optional>

#include "exact/big_rational.hpp"
#include "exact/exact_plane.hpp"
#include "halfspace/int128.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// The point of integers on the plane normal.x = offset that is nearest to the
/// origin, and of several the least; nothing where it is on no grid of 54 bits.
///
/// Requires: the normal's components have no common divisor.
/// Exact: yes. Cost: a reduction of two vectors (Lagrange and Gauss).
std::optional<GridPoint> lattice_point(const Vector3<Int128>& normal,
                                       const BigInteger& offset);

}  // namespace halfspace::fast
