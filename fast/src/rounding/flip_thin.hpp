#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rounding/grid_mesh.hpp"
#include "rounding/snap.hpp"

namespace halfspace::fast {

/// Exchanges edges between triangles of one plane, so that few are left that
/// rounding could turn over: a corner that lies nearly on a line with its
/// neighbours is cut off by no triangle where others will do.
///
/// `plane`: by triangle; those of one number are in one plane, with their loose
///          corners where they are.
/// `thin`:  the height, in steps, from which on none is exchanged.
/// Returns the pairs of triangles that shared an exchanged edge, which keep
/// their sources: those are one from then on.
///
/// Requires: no triangles of a plane overlap.
/// Keeps:    the surface, as a set of points, and the order of the triangles.
/// Cost:     linear, and n log n in the triangles of planes with thin ones.
/// Source:   LAW77, with heights in place of angles.
std::vector<std::pair<std::int32_t, std::int32_t>> flip_thin(
    GridMesh& mesh, std::span<const LoosePoint> loose,
    std::span<const std::int32_t> plane, double thin);

}  // namespace halfspace::fast
