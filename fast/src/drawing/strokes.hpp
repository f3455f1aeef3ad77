#pragma once

#include <vector>

#include "drawing/image_points.hpp"

namespace halfspace::fast {

/// Where an interval of a drawing lies on its edge.
struct Piece {
  std::int32_t line = 0;
  Cut from;
  Cut to;
};

/// Adds the strokes of a drawing, joined along the lines of the image (S9.6).
/// `pieces`: by interval; its edge is that of the same number in `lines`.
void add_strokes(Drawing& drawing, const std::vector<Line>& lines,
                 const std::vector<Piece>& pieces, const Hiding& hiding,
                 const ImagePoints& points);

}  // namespace halfspace::fast
