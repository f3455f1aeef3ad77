#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/io/legend.hpp"

namespace halfspace::io {

/// Where the parts of a legend stand. Units: pixels.
struct LegendLayout {
  bool fits = false;  ///< whether the picture is large enough
  std::vector<ScaleMark> marks;
  double letter = 0;      ///< from line to line
  std::int32_t left = 0;  ///< of the bar
  std::int32_t top = 0;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int32_t tick = 0;  ///< how long marks are
  double title_x = 0;
  std::int32_t box_left = 0, box_top = 0, box_right = 0, box_bottom = 0;
};

LegendLayout legend_layout(const Legend& legend, std::int32_t width_px,
                           std::int32_t height_px);

/// The colour of letters on a ground: dark or light.
Rgb letter_color(const Rgb& background);

}  // namespace halfspace::io
