#pragma once

#include <cstdint>

#include "halfspace/fast/drawing.hpp"
#include "halfspace/image.hpp"
#include "halfspace/line_style.hpp"

namespace halfspace::fast {

/// Which part of a picture an image is, and how lines are sampled there.
struct LineOptions {
  std::int32_t samples = 1;  ///< a pixel each way: 1, 2, 4 or 8
  std::int32_t left = 0;     ///< the column of the first pixel
  std::int32_t top = 0;      ///< its line
};

/// Draws the visible strokes of a drawing over the image that it is of, or a
/// part of that (S14.3).
///
/// Exact: yes: in doubles with a bound, and in rationals where a sample is as
///        far from a stroke as its half width, or nearly so.
/// Cost:  the pixels of the image, and the samples near strokes.
/// Returns how it was decided.
FilterStats add_lines(const Drawing& drawing, const LineStyle& style,
                      const LineOptions& how, ColorImage& image);

}  // namespace halfspace::fast
