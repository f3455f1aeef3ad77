#pragma once

#include <vector>

#include "rounding/file_grid.hpp"
#include "rounding/grid_mesh.hpp"
#include "rounding/snap.hpp"

namespace halfspace::fast {

/// Replaces a closed surface by that of the points that it winds round at least
/// once (S6.7), in triangles: it does not cross itself. Returns the points that
/// are not numbers of the file, which have no place in the mesh yet.
///
/// Keeps: where triangles came from.
/// Cost:  of resolve().
std::vector<LoosePoint> resolve_mesh(GridMesh& mesh, const FileGrid& grid,
                                     int threads);

}  // namespace halfspace::fast
