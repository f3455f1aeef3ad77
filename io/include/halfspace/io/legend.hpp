#pragma once

#include <cstdint>
#include <string>

#include "halfspace/image.hpp"
#include "halfspace/io/color_map.hpp"
#include "halfspace/scalars.hpp"

namespace halfspace::io {

/// What a legend shows of a scale.
struct Legend {
  ColorScale scale;
  ScaleRange range;
  std::string title;           ///< what the numbers are; maybe empty
  bool shows_no_data = false;  ///< whether the colour of no data is shown, too
};

/// How many columns at the right side of a picture a legend takes; 0 where the
/// picture is too small for one.
std::int32_t legend_width(const Legend& legend, std::int32_t width_px,
                          std::int32_t height_px);

/// Draws a legend over the right side of a picture: a bar of the scale's
/// colours, marks with their numbers, and the title; nothing where a picture is
/// too small for it.
///
/// Its size goes by the picture's, and its letters are dark or light against
/// the background. Where it would stand over something that is seen, it has a
/// ground of its own.
/// Requires: items of the picture, or of its samples.
void draw_legend(const Legend& legend, const ItemImage& items,
                 const Rgb& background, ColorImage& picture);

}  // namespace halfspace::io
