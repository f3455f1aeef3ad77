#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rounding/grid_mesh.hpp"
#include "rounding/snap.hpp"

namespace halfspace::fast {

/// Drops loose corners at which the surface hardly bends: those on a crease
/// that goes straight on, with triangles on either side that are nearly in one
/// plane. Cuts through polygons that rounding had bent and broken into
/// triangles leave such corners, at each of which the next cut would leave
/// more.
///
/// `kind`: by triangle; borders between those of different kinds stay.
/// `most`: no point of the surface moves farther. Units: steps.
/// Returns how far one did at most. The points are numbered anew, if any goes.
///
/// Requires: closed, edge by edge.
/// Shape:    closed as before; no edge that two triangles shared is shared by
///           more, and triangles face where those did that were there.
/// Keeps:    where triangles came from, but those that go.
/// Cost:     n log n in the triangles at loose corners.
/// Source:   SZL92, for corners that a rounding moves anyway.
double drop_straight_corners(GridMesh& mesh, std::vector<LoosePoint>& loose,
                             std::span<const std::uint64_t> kind, double most);

}  // namespace halfspace::fast
