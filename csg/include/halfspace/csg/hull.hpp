#pragma once

#include <vector>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/result.hpp"

namespace halfspace::csg {

/// The convex hull of points as triangles, faces outwards: the incremental
/// algorithm, with each decision exact.
///
/// Requires: their doubles are finite. `decimal` is noted in the mesh.
/// Errors:   kTooFewVertices (fewer than 4 points); kZeroArea (all in a plane).
/// Cost:     points times triangles of the hull.
Result<io::Mesh> hull_of(std::vector<Numbers3> points, bool decimal);

}  // namespace halfspace::csg
