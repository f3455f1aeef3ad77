#pragma once

#include <span>

#include "halfspace/io/mesh.hpp"
#include "halfspace/mesh.hpp"
#include "halfspace/result.hpp"

namespace halfspace::detail {

/// The convex hull of points as triangles, faces outwards: the incremental
/// algorithm, with each decision exact.
///
/// Requires: all are finite.
/// Errors:   kTooFewVertices (fewer than 4 points); kZeroArea (all in a plane).
/// Cost:     points times triangles of the hull.
Result<io::Mesh> hull_of(std::span<const Point> points);

}  // namespace halfspace::detail
