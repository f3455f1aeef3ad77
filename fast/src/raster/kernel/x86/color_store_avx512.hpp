#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "raster/kernel/x86/registers.hpp"

namespace halfspace::fast {
namespace {

/// The place of a byte in its pixel.
struct Places {
  std::uint8_t at[66];
};
constexpr Places kThirds = [] {
  Places places{};
  for (std::uint8_t b = 0; b < 66; ++b) places.at[b] = b % 3;
  return places;
}();

/// How items and colours are stored. Memory that a mask leaves out is neither
/// read nor written, so that it need not exist.
struct ColorStore : Registers {
  using Registers::store;

  /// Bits 0, 3, ... of 21 pixels.
  static constexpr std::uint64_t kEveryThird = 0x1249249249249249;

  /// The bytes of the first 21 pixels that have their bits set.
  static __mmask64 bytes_of_pixels(std::uint32_t bits) {
    return 7 * _pdep_u64(bits, kEveryThird);
  }

  /// The bytes of 16 pixels.
  static constexpr __mmask64 kSixteen = (std::uint64_t{1} << 48) - 1;

  /// Stores `id` at first + k for every bit k.
  static void store_items(std::int32_t* items, std::int64_t first,
                          std::uint32_t bits, std::int32_t id, bool) {
    const __m512i ids = _mm512_set1_epi32(id);
    _mm512_mask_storeu_epi32(items + first, static_cast<__mmask16>(bits), ids);
    _mm512_mask_storeu_epi32(items + first + 16,
                             static_cast<__mmask16>(bits >> 16), ids);
  }

  /// Copies those of 32 items, or of the colours of 32 pixels, that have their
  /// bits set.
  static void copy_some_items(std::int32_t* to, const std::int32_t* from,
                              std::uint32_t bits, bool) {
    for (int k = 0; k < 32; k += 16, bits >>= 16) {
      _mm512_mask_storeu_epi32(to + k, static_cast<__mmask16>(bits),
                               _mm512_loadu_si512(from + k));
    }
  }
  static void copy_some_colors(std::uint8_t* to, const std::uint8_t* from,
                               std::uint32_t bits, bool) {
    for (int k = 0; k < 96; k += 48, bits >>= 16) {
      const __mmask64 bytes = bytes_of_pixels(bits & 0xffffu);
      _mm512_mask_storeu_epi8(to + k, bytes,
                              _mm512_maskz_loadu_epi8(bytes, from + k));
    }
  }

  /// Copies 32 items, or the colours of 32 pixels.
  static void copy_items(std::int32_t* to, const std::int32_t* from) {
    copy_some_items(to, from, ~std::uint32_t{0}, true);
  }
  static void copy_colors(std::uint8_t* to, const std::uint8_t* from) {
    copy_some_colors(to, from, ~std::uint32_t{0}, true);
  }

  /// Stores `id` in a line of `tiles` tiles.
  static void fill_items(std::int32_t* to, std::int32_t tiles,
                         std::int32_t id) {
    const __m512i ids = _mm512_set1_epi32(id);
    for (std::int32_t k = 0; k < 2 * tiles; ++k) {
      _mm512_storeu_si512(to + 16 * k, ids);
    }
  }

  /// A colour over and over, in 64 bytes.
  struct FlatColor {
    __m512i bytes;
  };

  /// The same from its byte `first` on, which is 0, 1 or 2.
  static __m512i bytes_from(__m512i color, std::size_t first) {
    return _mm512_permutexvar_epi8(_mm512_loadu_si512(kThirds.at + first),
                                   color);
  }
  static FlatColor flat_color(std::uint32_t packed) {
    return {bytes_from(
        _mm512_castsi128_si512(_mm_cvtsi32_si128(static_cast<int>(packed))),
        0)};
  }

  /// Fills `tiles` times 32 pixels, one after another, mostly by whole lines of
  /// the cache.
  static void fill_colors(std::uint8_t* colors, std::int32_t tiles,
                          const FlatColor& color) {
    constexpr std::size_t kLine = 64;
    std::uint8_t* const last = colors + std::int64_t{96} * tiles - kLine;
    _mm512_storeu_si512(colors, color.bytes);
    const std::size_t skipped =
        kLine - reinterpret_cast<std::uintptr_t>(colors) % kLine;
    std::uint8_t* at = colors + skipped;
    // A line has a byte more than whole pixels.
    for (std::size_t first = skipped; at < last; at += kLine, ++first) {
      _mm512_store_si512(at, bytes_from(color.bytes, first % 3));
    }
    _mm512_storeu_si512(last, bytes_from(color.bytes, 2));
  }

  /// Stores the colour at pixel k after byte `first` for every bit k.
  static void store_colors(std::uint8_t* colors, std::int64_t first,
                           std::uint32_t bits, const FlatColor& color, bool) {
    std::uint8_t* at = colors + first;
    _mm512_mask_storeu_epi8(at, bytes_of_pixels(bits & 0xffffu), color.bytes);
    _mm512_mask_storeu_epi8(at + 48, bytes_of_pixels(bits >> 16), color.bytes);
  }

  /// The same, faster where the pixels are few. Requires: some bit is set.
  static void store_runs(std::uint8_t* line, std::uint32_t bits,
                         const FlatColor& color) {
    const int first = __builtin_ctz(bits);
    const std::uint32_t rest = bits >> first;
    std::uint8_t* at = line + 3 * first;
    _mm512_mask_storeu_epi8(at, bytes_of_pixels(rest), color.bytes);
    if (rest >> 21 != 0) {
      _mm512_mask_storeu_epi8(at + 63, bytes_of_pixels(rest >> 21),
                              color.bytes);
    }
  }

  /// The colours of a line of a tile, on their way.
  struct ColorLine {
    __m512i first;
    __m512i second;
  };

  static ColorLine line_of(const FlatColor& color) {
    return {color.bytes, color.bytes};
  }

  /// Lays the colour over the pixels `bits`.
  static void lay(ColorLine& line, std::uint32_t bits, const FlatColor& color) {
    line.first = _mm512_mask_mov_epi8(
        line.first, bytes_of_pixels(bits & 0xffffu), color.bytes);
    line.second = _mm512_mask_mov_epi8(line.second, bytes_of_pixels(bits >> 16),
                                       color.bytes);
  }

  static void store(std::uint8_t* to, const ColorLine& line) {
    _mm512_mask_storeu_epi8(to, kSixteen, line.first);
    _mm512_mask_storeu_epi8(to + 48, kSixteen, line.second);
  }

  /// Whether stores leave alone, unread, what a mask leaves out.
  static constexpr bool kMaskedStores = true;

  /// Stores 24 bytes: those of 8 pixels, or of the pixels `eight` alone.
  static void store_some(std::uint8_t* to, __m256i colors, std::uint32_t eight,
                         bool) {
    _mm512_mask_storeu_epi8(to, bytes_of_pixels(eight),
                            _mm512_castsi256_si512(colors));
  }
  static void store_eight(std::uint8_t* to, __m256i colors) {
    store_some(to, colors, 255u, true);
  }
};

}  // namespace
}  // namespace halfspace::fast
