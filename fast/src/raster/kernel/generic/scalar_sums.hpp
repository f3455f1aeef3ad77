#pragma once

#include <cstdint>

#include "raster/kernel/tile_view.hpp"

namespace halfspace::fast {
namespace {

/// Sums of samples' colours (S5.7), pixel by pixel: for processors that have
/// nothing better.
///
/// Of a tile they are a pixel's three channels after each other, row by row.
struct ScalarSums {
  static constexpr bool kAddsUp = true;

  /// Adds a colour for each of the samples `pixels` of a tile.
  template <class Words8>
  static void add_color(std::uint16_t* sums, std::int32_t samples,
                        const Words8& pixels, std::uint32_t packed) {
    const std::int32_t across = kTileWidth / samples;
    for (std::int32_t r = 0; r < kTileHeight; ++r) {
      std::uint32_t bits = pixels.lines[r];
      std::uint16_t* at = sums + 3 * (r / samples * across);
      for (; bits != 0; bits &= bits - 1) {
        std::uint16_t* to = at + 3 * (__builtin_ctz(bits) / samples);
        for (int c = 0; c < 3; ++c) {
          to[c] = static_cast<std::uint16_t>(to[c] + (packed >> 8 * c & 255));
        }
      }
    }
  }

  /// Writes the means of a tile's pixels in these of its columns and rows. The
  /// tile's first pixel is at `means`, a row every `stride` bytes.
  static void write_tile_means(const std::uint16_t* sums, std::int32_t samples,
                               PixelRange columns, PixelRange rows,
                               std::uint8_t* means, std::int64_t stride) {
    const std::int32_t across = kTileWidth / samples;
    const std::int32_t count = samples * samples;
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
      for (std::int32_t k = 3 * columns.first; k < 3 * columns.end; ++k) {
        means[j * stride + k] = static_cast<std::uint8_t>(
            (sums[3 * across * j + k] + count / 2) / count);
      }
    }
  }
};

}  // namespace
}  // namespace halfspace::fast
