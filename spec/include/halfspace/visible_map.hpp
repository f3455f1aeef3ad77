#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/image.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace {

/// The key of the background, and of what is outside of the image (S7.3).
constexpr std::int32_t kBackgroundKey = -1;
constexpr std::int32_t kOutsideKey = -2;

/// What a visible map depends on, beside scene and camera (S7.1, S7.3).
struct MapOptions {
  bool cull = false;  ///< as ImageOptions::cull
  /// One key a polygon, not negative; empty: its id.
  std::vector<std::int32_t> keys;
};

/// How the polygons of an image are looked at.
struct Look {
  std::uint8_t alpha = kOpaque;  ///< below that they are blended (S5.6)
  std::int32_t samples = 1;      ///< a pixel each way: 1, 2, 4 or 8 (S5.7)
  std::optional<Rgb> mark = std::nullopt;  ///< of back faces (S5.8)
};

/// What a transparent map depends on, beside scene and camera (S7.8).
struct TransparentOptions {
  bool cull = false;  ///< as ImageOptions::cull
  std::uint8_t alpha = kOpaque;
  Rgb background = {255, 255, 255};
  /// One alpha a polygon; empty: `alpha` for all.
  std::vector<std::uint8_t> alphas = {};
  /// Of the caps of each part, and last of several (S10.7), or of caps that are
  /// not told apart; empty: `alpha` for all.
  std::vector<std::uint8_t> cap_alphas = {};

  std::uint8_t alpha_of(PolygonId polygon) const {
    return alphas.empty() ? alpha : alphas[static_cast<std::size_t>(polygon)];
  }
  std::uint8_t alpha_of_cap(std::size_t part) const {
    return cap_alphas.empty() ? alpha : cap_alphas[part];
  }
};

/// The key of a colour in a transparent map (S7.8), and its inverse.
constexpr std::int32_t color_key(Rgb color) {
  return color.r << 16 | color.g << 8 | color.b;
}
constexpr Rgb color_of_key(std::int32_t key) {
  return {static_cast<std::uint8_t>(key >> 16 & 255),
          static_cast<std::uint8_t>(key >> 8 & 255),
          static_cast<std::uint8_t>(key & 255)};
}

/// What a polygon of this colour makes of the colour behind it (S5.6).
constexpr Rgb composed_color(Rgb over, Rgb behind, std::uint8_t alpha) {
  const auto channel = [alpha](int c, int v) {
    return static_cast<std::uint8_t>(
        (2 * (alpha * c + (kOpaque - alpha) * v) + kOpaque) / (2 * kOpaque));
  };
  return {channel(over.r, behind.r), channel(over.g, behind.g),
          channel(over.b, behind.b)};
}

}  // namespace halfspace
