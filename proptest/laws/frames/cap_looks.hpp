#pragma once

#include <cstddef>
#include <cstdint>

#include "definition/definition.hpp"
#include "generate/cut_boxes.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/scene_file.hpp"

/// How caps look by the definition.
namespace halfspace {

/// Whether a point at which that is the sum or the difference of coordinates,
/// less a half or more by it, is in a stripe (S10.4).
inline bool is_in_stripe(definition::Fraction rest, int period) {
  while (rest < 0) rest += period;
  while (rest >= period) rest -= period;
  return rest < 2;
}

/// The colour of the cap with that number beyond the polygons (S10.6) at the
/// point of sample (x, y) of so many a pixel.
inline Rgb stripe_color(const ImageOptions& options, std::size_t beyond,
                        std::int32_t x, std::int32_t y, std::int32_t samples) {
  using definition::Fraction;
  const std::size_t plane = beyond % 8;
  const std::size_t part = beyond / 16;
  const CapStyle& style =
      options.parts ? options.parts->styles[part] : *options.caps;
  if (!style.hatch) return style.color;
  const Fraction px = Fraction(2 * x + 1) / Fraction(2 * samples);
  const Fraction py = Fraction(2 * y + 1) / Fraction(2 * samples);
  const Fraction half = Fraction(1) / Fraction(2);
  const bool is_several =
      options.parts && part + 1 == options.parts->styles.size();
  const int period = !is_several && (part % 4 == 2 || part % 4 == 3) ? 16 : 8;
  const bool by_sum = is_several || (plane + part) % 2 == 0;
  const bool by_difference = is_several || !by_sum;
  const bool is_hatched =
      (by_sum && is_in_stripe(px + py - half, period)) ||
      (by_difference && is_in_stripe(px - py + half, period));
  return is_hatched ? *style.hatch : style.color;
}

}  // namespace halfspace
