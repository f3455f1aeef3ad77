#pragma once

#include <algorithm>
#include <cstdint>

#include "halfspace/polygon.hpp"

namespace halfspace::fast {

/// The mark in the light of a polygon that has this colour (S5.8).
inline Rgb marked(const Rgb& mark, const Rgb& color) {
  const int light = std::max({color.r, color.g, color.b});
  const auto channel = [light](int full) {
    return static_cast<std::uint8_t>((full * (255 + light) + 255) / 510);
  };
  return {channel(mark.r), channel(mark.g), channel(mark.b)};
}

}  // namespace halfspace::fast
