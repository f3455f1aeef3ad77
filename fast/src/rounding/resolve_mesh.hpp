#pragma once

#include <vector>

#include "rounding/file_grid.hpp"
#include "rounding/grid_mesh.hpp"
#include "rounding/mesh_contacts.hpp"
#include "rounding/mesh_index.hpp"
#include "rounding/snap.hpp"

namespace halfspace::fast {

/// Replaces a closed surface by that of the points that it winds round at least
/// once (S6.7), in triangles: it does not cross itself. Returns the points that
/// are not numbers of the file, which have no place in the mesh yet.
///
/// `index`: of a mesh that this one came from, or empty; afterwards of this one
///          as it was.
///
/// Requires: `contacts` are the mesh's, and if any triangles meet, all that do.
/// Keeps: where triangles came from; triangles that meet no others as they are.
/// Cost:  of resolve() for the triangles that meet others, and those beside
///        them; n log n for the rest.
std::vector<LoosePoint> resolve_mesh(GridMesh& mesh,
                                     const MeshContacts& contacts,
                                     MeshIndex& index, const FileGrid& grid,
                                     int threads);

}  // namespace halfspace::fast
