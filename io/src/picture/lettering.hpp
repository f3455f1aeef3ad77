#pragma once

#include <cstdint>
#include <string_view>

#include "halfspace/image.hpp"

namespace halfspace::io {

/// Letters for pictures: those of DejaVu Sans, which the library holds, at any
/// size, smoothed. The same bytes on every machine.
class Lettering {
 public:
  /// Letters whose lines are `height_px` apart.
  explicit Lettering(double height_px);

  /// How far the text reaches. Units: pixels.
  double width_of(std::string_view text) const;

  /// How far capitals stand above the line that text stands on.
  double capital_height() const { return 0.73 * size_; }

  /// Writes text that begins at (x, y) and stands on that line of the picture.
  void write(std::string_view text, double x, double y, const Rgb& color,
             ColorImage& picture) const;

 private:
  double size_;  ///< of the letter M's square
  float scale_;  ///< pixels a unit of the font
};

}  // namespace halfspace::io
