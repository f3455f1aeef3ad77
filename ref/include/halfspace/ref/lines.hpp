#pragma once

#include <cstdint>

#include "halfspace/image.hpp"
#include "halfspace/line_style.hpp"
#include "halfspace/ref/drawing.hpp"

namespace halfspace::ref {

/// Whether an image point is on the line between two others, rounded (S14.2).
/// Exact: yes, once the ends are rounded.
bool is_on_line(const ImagePoint& point, const ImagePoint& from,
                const ImagePoint& to, std::int32_t width);

/// Draws the visible strokes of a drawing over the image that it is of, with
/// `samples` x `samples` samples a pixel (S14.3).
///
/// Exact: yes, once ends are rounded. Cost: strokes times samples.
void add_lines(const Drawing& drawing, const LineStyle& style,
               std::int32_t samples, ColorImage& image);

}  // namespace halfspace::ref
