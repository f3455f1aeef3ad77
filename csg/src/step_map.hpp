#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::csg {

/// An affine map of grid points, in integers: it takes (x, y, z, 1) to its
/// rows' products with that, times 2^two 5^five model units.
struct StepMap {
  std::array<std::array<io::Integer, 4>, 3> rows;
  std::int32_t two = 0;
  std::int32_t five = 0;
};

/// What `matrix` does to points on a grid of this unit. Exact: yes.
StepMap step_map(const Matrix& matrix, const Unit& unit);

/// What the choice of a grid asks of some coordinates (S1.7).
struct Extent {
  io::Number step;  ///< 2^i 5^j, the greatest of which all are multiples
  io::Number least;
  io::Number greatest;
};

/// The extent of the images of points. Exact: yes.
Extent extent_of(const StepMap& map, std::span<const GridPoint> points);

/// Points on a grid, and how far they moved to get there.
struct PlacedPoints {
  std::vector<GridPoint> points;
  std::size_t moved = 0;  ///< coordinates
  double max_move = 0;    ///< Units: model units
};

/// The images of points on the grid of a unit, halves rounded away from zero.
///
/// Requires: they fit in 54 bits there.
/// Exact:    but for the rounding reported, yes.
PlacedPoints placed(const StepMap& map, std::span<const GridPoint> points,
                    const Unit& unit);

}  // namespace halfspace::csg
