#pragma once

#include <immintrin.h>

#include <cstdint>
#include <cstring>

#if defined(__AVX512VBMI__)
#include "raster/kernel/x86/color_store_avx512.hpp"
#else
#include "raster/kernel/x86/color_store_avx2.hpp"
#endif
#include "raster/kernel/tile_view.hpp"

namespace halfspace::fast {
namespace {

/// Sums of samples' colours (S5.7) in 16 bits, 16 at once: 64 channels fill 14
/// of these.
///
/// Half a register has eight pixels of a row. Those of a tile are, by their
/// lines: of 4 x 4 samples one register, of 2 x 2 four, its left and its right
/// of the first two rows of a half, then those of the last two; each for red,
/// green and blue. Of 8 x 8 samples one register has all: 4 reds, 4 greens and
/// 4 blues.
struct ColorSums : ColorStore {
  static constexpr bool kAddsUp = true;

  /// Adds a colour for each of the samples `pixels` of a tile.
  static void add_color(std::uint16_t* sums, std::int32_t samples,
                        Words8 pixels, std::uint32_t packed) {
    if (samples == 8) return add_to_four(sums, pixels, packed);
    const __m256i color[3] = {
        _mm256_set1_epi16(static_cast<short>(packed & 255)),
        _mm256_set1_epi16(static_cast<short>(packed >> 8 & 255)),
        _mm256_set1_epi16(static_cast<short>(packed >> 16 & 255))};
    const auto add = [&](int k, __m256i counts) {
      for (int c = 0; c < 3; ++c) {
        auto* at = reinterpret_cast<__m256i*>(sums) + 3 * k + c;
        _mm256_storeu_si256(
            at, _mm256_add_epi16(_mm256_loadu_si256(at),
                                 _mm256_mullo_epi16(counts, color[c])));
      }
    };
    const __m256i zero = _mm256_setzero_si256();
    if (samples == 4) {
      add(0, _mm256_unpacklo_epi8(counts_of_fours(pixels.bits), zero));
      return;
    }
    __m256i rows[2];
    count_twos(pixels.bits, rows);
    for (int k = 0; k < 2; ++k) {
      add(2 * k, _mm256_unpacklo_epi8(rows[k], zero));
      add(2 * k + 1, _mm256_unpackhi_epi8(rows[k], zero));
    }
  }

  /// Writes the means of a tile's pixels in these of its columns and rows. The
  /// tile's first pixel is at `means`, a row every `stride` bytes.
  static void write_tile_means(const std::uint16_t* sums, std::int32_t samples,
                               PixelRange columns, PixelRange rows,
                               std::uint8_t* means, std::int64_t stride) {
    if (samples == 8) {
      for (std::int32_t i = columns.first; i < columns.end; ++i) {
        for (int c = 0; c < 3; ++c) {
          means[3 * i + c] =
              static_cast<std::uint8_t>((sums[4 * c + i] + 32) / 64);
        }
      }
      return;
    }
    const int registers = samples == 4 ? 1 : 4;
    const __m128i shift = _mm_cvtsi32_si128(samples == 4 ? 4 : 2);
    const __m256i half =
        _mm256_set1_epi16(static_cast<short>(samples * samples / 2));
    for (int k = 0; k < registers; ++k) {
      __m256i mean[3];
      for (int c = 0; c < 3; ++c) {
        const __m256i sum = _mm256_loadu_si256(
            reinterpret_cast<const __m256i*>(sums) + 3 * k + c);
        mean[c] = _mm256_srl_epi16(_mm256_add_epi16(sum, half), shift);
      }
      alignas(32) std::uint8_t rgb[2][32];
      interleave(mean, rgb);
      const std::int32_t x = 8 * (k % 2);
      const std::int32_t first = columns.first > x ? columns.first - x : 0;
      const std::int32_t end = columns.end - x < 8 ? columns.end - x : 8;
      if (first >= end) continue;
      for (std::int32_t h = 0; h < 2; ++h) {
        const std::int32_t j = samples == 4 ? h : 2 * h + k / 2;
        if (j < rows.first || j >= rows.end) continue;
        std::uint8_t* to = means + j * stride + 3 * x;
        if (first == 0 && end == 8) {
          std::memcpy(to, rgb[h], 24);
        } else {
          std::memcpy(to + 3 * first, rgb[h] + 3 * first,
                      static_cast<std::size_t>(3 * (end - first)));
        }
      }
    }
  }

 private:
  /// How many bits are set of each half of each byte: those of the lower and
  /// those of the upper halves.
  struct Halves {
    __m256i lower;
    __m256i upper;
  };
  static Halves count_halves(__m256i bits) {
    const __m256i counts =
        _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4, 0, 1,
                         1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
    const __m256i lower = _mm256_set1_epi8(15);
    return {_mm256_shuffle_epi8(counts, _mm256_and_si256(bits, lower)),
            _mm256_shuffle_epi8(
                counts, _mm256_and_si256(_mm256_srli_epi16(bits, 4), lower))};
  }

  /// Of 4 x 4 bits, eight bytes of each half; the rest is of no use.
  static __m256i counts_of_fours(__m256i bits) {
    const Halves halves = count_halves(bits);
    // The four lines of a half are added up two by two.
    const auto add_lines = [](__m256i v) {
      return _mm256_add_epi8(v, _mm256_shuffle_epi32(v, 0x4e));
    };
    const __m256i pairs =
        _mm256_unpacklo_epi8(add_lines(halves.lower), add_lines(halves.upper));
    return add_lines(pairs);
  }

  /// Of 2 x 2 bits: of each half the 16 pixels of its first row, and of its
  /// second.
  static void count_twos(__m256i bits, __m256i (&rows)[2]) {
    const auto masked = [](__m256i v, int mask) {
      return _mm256_and_si256(v, _mm256_set1_epi8(static_cast<char>(mask)));
    };
    const __m256i twos = _mm256_add_epi8(
        masked(bits, 0x55), masked(_mm256_srli_epi16(bits, 1), 0x55));
    const auto add_lines = [](__m256i v) {
      return _mm256_add_epi8(v, _mm256_shuffle_epi32(v, 0xb1));
    };
    // Of four pixels in a byte the first and third, the second and fourth.
    const __m256i even = add_lines(masked(twos, 0x33));
    const __m256i odd = add_lines(masked(_mm256_srli_epi16(twos, 2), 0x33));
    const __m256i first = masked(even, 15);
    const __m256i second = masked(odd, 15);
    const __m256i third = masked(_mm256_srli_epi16(even, 4), 15);
    const __m256i fourth = masked(_mm256_srli_epi16(odd, 4), 15);
    rows[0] = _mm256_unpacklo_epi16(_mm256_unpacklo_epi8(first, second),
                                    _mm256_unpacklo_epi8(third, fourth));
    rows[1] = _mm256_unpacklo_epi16(_mm256_unpackhi_epi8(first, second),
                                    _mm256_unpackhi_epi8(third, fourth));
  }

  /// The same as add_color() for 8 x 8 samples.
  static void add_to_four(std::uint16_t* sums, Words8 pixels,
                          std::uint32_t packed) {
    const Halves halves = count_halves(pixels.bits);
    __m256i bytes = _mm256_add_epi8(halves.lower, halves.upper);
    bytes = _mm256_add_epi8(bytes, _mm256_permute2x128_si256(bytes, bytes, 1));
    bytes = _mm256_add_epi8(bytes, _mm256_shuffle_epi32(bytes, 0x4e));
    bytes = _mm256_add_epi8(bytes, _mm256_shuffle_epi32(bytes, 0xb1));
    const __m256i counts = _mm256_unpacklo_epi8(bytes, _mm256_setzero_si256());
    const auto r = static_cast<short>(packed & 255);
    const auto g = static_cast<short>(packed >> 8 & 255);
    const auto b = static_cast<short>(packed >> 16 & 255);
    const __m256i color =
        _mm256_setr_epi16(r, r, r, r, g, g, g, g, b, b, b, b, 0, 0, 0, 0);
    auto* at = reinterpret_cast<__m256i*>(sums);
    _mm256_storeu_si256(at,
                        _mm256_add_epi16(_mm256_loadu_si256(at),
                                         _mm256_mullo_epi16(counts, color)));
  }

  /// Channels of 16 bits, below 256, as colours: 24 bytes of each half.
  static void interleave(const __m256i (&channels)[3],
                         std::uint8_t (&rgb)[2][32]) {
    const __m256i rg = _mm256_packus_epi16(channels[0], channels[1]);
    const __m256i b = _mm256_packus_epi16(channels[2], channels[2]);
    const auto both = [](__m128i places) {
      return _mm256_broadcastsi128_si256(places);
    };
    const __m256i head = _mm256_or_si256(
        _mm256_shuffle_epi8(
            rg, both(_mm_setr_epi8(0, 8, -1, 1, 9, -1, 2, 10, -1, 3, 11, -1, 4,
                                   12, -1, 5))),
        _mm256_shuffle_epi8(
            b, both(_mm_setr_epi8(-1, -1, 0, -1, -1, 1, -1, -1, 2, -1, -1, 3,
                                  -1, -1, 4, -1))));
    const __m256i tail = _mm256_or_si256(
        _mm256_shuffle_epi8(
            rg, both(_mm_setr_epi8(13, -1, 6, 14, -1, 7, 15, -1, -1, -1, -1, -1,
                                   -1, -1, -1, -1))),
        _mm256_shuffle_epi8(
            b, both(_mm_setr_epi8(-1, 5, -1, -1, 6, -1, -1, 7, -1, -1, -1, -1,
                                  -1, -1, -1, -1))));
    const auto put = [](std::uint8_t* to, __m128i bytes) {
      _mm_store_si128(reinterpret_cast<__m128i*>(to), bytes);
    };
    put(rgb[0], _mm256_castsi256_si128(head));
    put(rgb[0] + 16, _mm256_castsi256_si128(tail));
    put(rgb[1], _mm256_extracti128_si256(head, 1));
    put(rgb[1] + 16, _mm256_extracti128_si256(tail, 1));
  }
};

}  // namespace
}  // namespace halfspace::fast
