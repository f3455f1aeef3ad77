#pragma once

#include <cstdint>
#include <vector>

#include "rounding/file_grid.hpp"
#include "rounding/grid_mesh.hpp"
#include "rounding/mesh_contacts.hpp"

namespace halfspace::fast {

/// A point of a mesh that is not on the grid yet, and where it is.
struct LoosePoint {
  std::int32_t point = 0;
  StepPoint at;
};

/// The farthest that a point was moved, and where that came to lie.
struct LargestMove {
  double distance = 0;  ///< along an axis. Units: steps
  GridPoint to;
};

/// Rounds a mesh's loose points to the grid. They are marked as moved, and no
/// others.
LargestMove snap(GridMesh& mesh, const std::vector<LoosePoint>& loose,
                 const FileGrid& grid);

/// Rounds the corners of triangles that meet others to multiples of `width`,
/// which is one of the grid's spacing and a power of two times that, and every
/// other point that goes to one of those places. All that moved is marked.
/// Source: VL25, which does so with all points of such cells.
LargestMove coarsened(GridMesh& mesh, const MeshContacts& contacts,
                      const FileGrid& grid, std::int64_t width);

}  // namespace halfspace::fast
