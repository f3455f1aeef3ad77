#pragma once

#include <cstdint>

#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {
namespace {

/// What a Simd policy takes to write pixels, one at a time: for processors that
/// have nothing better.
struct ScalarPixels {
  /// Whether small triangles are shaded from their corners in the image.
  static constexpr bool kShadesSmall = false;
  /// Whether polygons back to front are drawn eight at a time, too.
  static constexpr bool kShowsSmall = false;

  /// Stores `id` at first + k for every bit k.
  static void store_items(std::int32_t* items, std::int64_t first,
                          std::uint32_t bits, std::int32_t id, bool) {
    for (; bits != 0; bits &= bits - 1) items[first + __builtin_ctz(bits)] = id;
  }

  /// Stores `id` in a line of `tiles` tiles.
  static void fill_items(std::int32_t* to, std::int32_t tiles,
                         std::int32_t id) {
    for (std::int32_t k = 0; k < 32 * tiles; ++k) to[k] = id;
  }

  /// Copies 32 items, or the colours of 32 pixels.
  static void copy_items(std::int32_t* to, const std::int32_t* from) {
    for (int k = 0; k < 32; ++k) to[k] = from[k];
  }

  static void copy_colors(std::uint8_t* to, const std::uint8_t* from) {
    for (int k = 0; k < 96; ++k) to[k] = from[k];
  }

  /// Copies those that have their bits set.
  static void copy_some_items(std::int32_t* to, const std::int32_t* from,
                              std::uint32_t bits, bool) {
    for (; bits != 0; bits &= bits - 1) {
      to[__builtin_ctz(bits)] = from[__builtin_ctz(bits)];
    }
  }

  static void copy_some_colors(std::uint8_t* to, const std::uint8_t* from,
                               std::uint32_t bits, bool) {
    for (; bits != 0; bits &= bits - 1) {
      const int k = 3 * __builtin_ctz(bits);
      for (int c = k; c < k + 3; ++c) to[c] = from[c];
    }
  }

  struct FlatColor {
    std::uint8_t rgb[3];
  };

  static FlatColor flat_color(std::uint32_t packed) {
    return {{static_cast<std::uint8_t>(packed),
             static_cast<std::uint8_t>(packed >> 8),
             static_cast<std::uint8_t>(packed >> 16)}};
  }

  /// Fills `tiles` times 32 pixels, one after another.
  static void fill_colors(std::uint8_t* colors, std::int32_t tiles,
                          const FlatColor& color) {
    for (std::int32_t k = 0; k < 3 * 32 * tiles; ++k) {
      colors[k] = color.rgb[k % 3];
    }
  }

  /// Stores the colour at pixel k after byte `first` for every bit k.
  static void store_colors(std::uint8_t* colors, std::int64_t first,
                           std::uint32_t bits, const FlatColor& color, bool) {
    for (; bits != 0; bits &= bits - 1) {
      std::uint8_t* at = colors + first + 3 * __builtin_ctz(bits);
      at[0] = color.rgb[0];
      at[1] = color.rgb[1];
      at[2] = color.rgb[2];
    }
  }

  /// Here all tiles are put together part by part.
  template <class Words8>
  static bool write_flat(const TileView&, const MaskList&, bool, std::int32_t,
                         std::int32_t, const Words8&, const PixelSource*) {
    return false;
  }

  /// Here each line is for itself.
  static bool shade_blocks(const Target&, const Gradient&, std::int32_t,
                           std::int32_t, const std::uint32_t*, std::uint32_t*) {
    return false;
  }

  struct ShadedTile {};

  static bool start_tile(const Gradient&, std::int32_t, std::int32_t,
                         std::uint32_t, const std::uint32_t*, ShadedTile&) {
    return false;
  }

  static void shade_lines(const Target&, const ShadedTile&, std::uint32_t,
                          const std::uint32_t*, std::uint32_t*) {}

  /// Colours the pixels `bits` of line r of a tile; gives those in doubt.
  static std::uint32_t shade_pixels(const Target& target,
                                    const ShadedLine& line, std::int32_t r,
                                    std::uint32_t bits) {
    std::uint32_t left = 0;
    std::uint8_t* to = target.colors + target.at + r * target.stride;
    for (; bits != 0; bits &= bits - 1) {
      const int pixel = __builtin_ctz(bits);
      const auto steps = static_cast<float>(pixel - line.first);
      const float reciprocal = 1 / (line.d0 + line.d * steps);
      for (int c = 0; c < 3; ++c) {
        const float value = (line.n0[c] + line.n1[c] * steps) * reciprocal;
        // Pixels that are not covered are not asked for: this fits.
        const auto level = static_cast<std::int32_t>(value);
        if (((level + line.doubt) & 0xffff) < 2 * line.doubt) {
          left |= 1u << pixel;
        }
        to[3 * pixel + c] = static_cast<std::uint8_t>(level >> 16);
      }
    }
    return left;
  }
};

}  // namespace
}  // namespace halfspace::fast
