#pragma once

#include <cstddef>
#include <vector>

#include "camera/view.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/image.hpp"
#include "map/convex_cutter.hpp"

namespace halfspace::fast {

/// A convex part of a cap in the image, all in a stripe of the hatching or all
/// outside, and all of one part of the scene.
struct CapPiece {
  std::vector<HalfPlane> sides;
  CapItem cap;
};

/// The cap of clip plane `k` (S10.3) as convex pieces of the image.
///
/// The image of the plane is divided by the lines of the polygons that cross
/// it, each where its segment may pass; the winding number of a piece is that
/// of a point inside, told by the segments along a line of the plane.
/// Requires: a closed scene; image.caps; the table has image.clips; the eye is
///           on side `side` of the plane, not 0.
/// Exact:    yes: doubles say where a segment passes no piece, rationals the
///           rest.
/// Cost:     with n segments n log n pieces or so, n comparisons for each.
std::vector<CapPiece> cap_pieces(const TreeReader& reader, const View& view,
                                 const CameraData& camera,
                                 const ImageOptions& image, std::size_t k,
                                 int side, LineTable& lines);

}  // namespace halfspace::fast
