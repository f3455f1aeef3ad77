#pragma once

#include "exact/exact_plane.hpp"
#include "halfspace/int128.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// A point of the grid on the plane through `point` with this normal, which
/// depends on nothing but the plane as a set of points in space: in steps that
/// are `base` times as fine the same plane gives the same point.
///
/// Of the grids whose steps are 1, base, base^2 and so on it is of the coarsest
/// that has points on the plane, not farther than this one reaches; of its
/// points on the plane the nearest to the origin, and of several the least. If
/// that is beyond the grid, `point`.
///
/// Requires: `point` is on the grid.
/// Exact: yes. Cost: a reduction of two vectors (Lagrange and Gauss).
GridPoint lattice_point(const Vector3<Int128>& normal, const GridPoint& point,
                        int base, int grid_bits);

}  // namespace halfspace::fast
