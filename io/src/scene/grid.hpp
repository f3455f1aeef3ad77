#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/io/import.hpp"
#include "halfspace/io/mesh.hpp"

namespace halfspace::io {

/// The grid on which a mesh becomes a scene (S1.7).
struct GridChoice {
  Unit unit;
  int bits = 26;
};

/// The grid for the vertices that are `used`, as import_scene() says.
/// Errors: kOutOfRange (options.grid_bits is no grid; no unit reaches far
///         enough).
Result<GridChoice> choose_grid(const Mesh& mesh, const std::vector<bool>& used,
                               const ImportOptions& options);

/// A coordinate in grid steps, and how far it moved to get there.
struct GridCoordinate {
  std::int64_t steps = 0;
  bool moved = false;
  double move = 0;  ///< Units: model units
};

/// The grid coordinate nearest to a number; halves go away from zero.
/// Requires: the number is less than 2^62 units, as it is in a unit that
///           choose_grid() gives for a mesh with that number.
/// Exact:    `steps` and `moved` are.
GridCoordinate to_grid(const Number& number, const Unit& unit);

}  // namespace halfspace::io
