#pragma once

#include <cstdint>
#include <vector>

#include "rounding/file_grid.hpp"
#include "rounding/grid_mesh.hpp"
#include "rounding/mesh_contacts.hpp"
#include "rounding/mesh_index.hpp"
#include "rounding/snap.hpp"

namespace halfspace::fast {

/// What untangle() did.
struct Untangled {
  /// From where a point was to be to where it is now; of those that it moved.
  LargestMove farthest;
  std::vector<std::uint8_t> changed;  ///< by point: whether it moved it
};

/// Moves points to places nearby at which fewer of their triangles meet any:
/// one after another, those that were rounded last before the others, as long
/// as that helps. They are marked as moved.
///
/// `contacts`: which triangles meet, all pairs of them.
/// `may`:      by point: whether it is tried.
/// `loose`:    the points that were rounded last, and where they were; the
///             others were to be where they are.
/// `index`:    of the mesh as it is, not empty; afterwards, as it was.
///
/// Keeps: the triangles; each has an area.
/// Cost:  bounded by the size of the mesh: it ends with what it has then.
Untangled untangle(GridMesh& mesh, const MeshContacts& contacts,
                   const std::vector<std::uint8_t>& may,
                   const std::vector<LoosePoint>& loose, const MeshIndex& index,
                   const FileGrid& grid);

}  // namespace halfspace::fast
