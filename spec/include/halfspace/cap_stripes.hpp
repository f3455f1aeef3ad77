#pragma once

#include "halfspace/clip.hpp"

namespace halfspace {

/// The colour of the cap of clip plane `plane` at sample (i, j) of all, so many
/// a pixel each way (S10.4).
constexpr Rgb cap_color_at_sample(const CapStyle& style, std::size_t plane,
                                  std::int32_t i, std::int32_t j,
                                  std::int32_t samples) {
  // The function of the stripes in halves of samples, where a pixel has
  // 2 samples of them; 2^20 pixels are a multiple of 8 beyond any row.
  const std::int64_t pixel = 2 * samples;
  const std::int64_t across =
      plane % 2 == 0 ? std::int64_t{2} * i + 2 * std::int64_t{j} + 2 - samples
                     : std::int64_t{2} * i - 2 * std::int64_t{j} + samples +
                           pixel * (std::int64_t{1} << 20);
  return style.hatch && across % (8 * pixel) < 2 * pixel ? *style.hatch
                                                         : style.color;
}

}  // namespace halfspace
