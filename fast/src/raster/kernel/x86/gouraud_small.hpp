#pragma once

#include <immintrin.h>

#include <cstdint>

#include "raster/kernel/generic/scalar.hpp"
#include "raster/kernel/x86/gouraud_blocks.hpp"

namespace halfspace::fast {
namespace {

/// Smooth colours of small triangles, from their corners in the image.
struct GouraudSmall : GouraudBlocks {
  static constexpr bool kShadesSmall = true;
  static constexpr bool kShowsSmall = true;

  /// The colours of a triangle from its corners in the image; false: this is
  /// too little.
  ///
  /// Let r be the weights over the first one's, q a channel times r: over the
  /// image the channel is N / T, N and T being the affine functions that are q
  /// and r at the corners. E is the largest difference to the first corner, A
  /// twice the area, u = 2^-53. T, 1 at the first corner, changes by at most a
  /// quarter within E, so it is from 3/4 to 5/4 where it matters.
  ///
  /// Corners: at the true corners N is off by G times `error`, G being the sum
  /// of the sizes of its slopes, and so it is within the triangle, where the
  /// pixels are. Weights: N is off by w' = weight_error + 2u of 510, T of 2.
  /// Rounding: a slope is a difference of two products of at most 510 E, of
  /// factors off by 3u 510 and u E, over A: off by 12u 510 E / A, and with h =
  /// 16u E E / A by h of itself, as A is off by 8u E E. Over the way from the
  /// first corner, at most E each way, and with what that adds, N is off by
  /// G (error + 2 E h) + 1280 h + 510 w', and T by G' (error + 2 E h) + 6 h +
  /// 2 w'. Columns and lines are at most x0 + E + 1 and y0 + E + 1, with the
  /// first corner (x0, y0): the products with them, and the sums, add 8u G (x0
  /// + y0 + 2 E + 2). With G <= 2040 E / A, G' <= 6 E / A, 256 of what T is
  /// off, and T at least 1/2, a level is off by at most 7200 E / A (error + 2 E
  /// h + 8u (x0 + y0 + 2 E + 2)) + 5800 h + 2060 w'; the doubt is that times T.
  static bool small_gradient(const SmallTriangle& t, const std::uint8_t* colors,
                             Gradient& gradient) {
    constexpr double kUnit = 0x1p-53;
    const double x1 = t.x[1] - t.x[0], x2 = t.x[2] - t.x[0];
    const double y1 = t.y[1] - t.y[0], y2 = t.y[2] - t.y[0];
    const double inverse = 1 / (x1 * y2 - x2 * y1);
    const double extent =
        scalar::most(scalar::most(scalar::size_of(x1), scalar::size_of(x2)),
                     scalar::most(scalar::size_of(y1), scalar::size_of(y2)));
    const double thin = extent * scalar::size_of(inverse);
    const double h = 16 * kUnit * extent * thin;
    const __m256d q0 = corner_color(colors, 0);
    const auto product = [](__m256d v, double f) {
      return _mm256_mul_pd(v, _mm256_set1_pd(f));
    };
    const __m256d q1 = _mm256_sub_pd(
        product(corner_color(colors, 1), t.weight[1] * t.first_depth), q0);
    const __m256d q2 = _mm256_sub_pd(
        product(corner_color(colors, 2), t.weight[2] * t.first_depth), q0);
    const __m256d across =
        product(_mm256_sub_pd(product(q1, y2), product(q2, y1)), inverse);
    const __m256d down =
        product(_mm256_sub_pd(product(q2, x1), product(q1, x2)), inverse);
    _mm256_store_pd(gradient.a, across);
    _mm256_store_pd(gradient.b, down);
    _mm256_store_pd(
        gradient.c,
        _mm256_add_pd(q0, _mm256_add_pd(product(across, 0.5 - t.x[0]),
                                        product(down, 0.5 - t.y[0]))));
    const double far =
        scalar::size_of(t.x[0]) + scalar::size_of(t.y[0]) + 2 * extent + 2;
    gradient.doubt =
        1.25 * (7200 * thin * (t.error + 2 * extent * h + 8 * kUnit * far) +
                5800 * h + 2060 * (t.weight_error + 2 * kUnit));
    // Where the area is too small to trust they are large, or no numbers.
    return gradient.doubt < 0x1p-6 &&
           (scalar::size_of(gradient.a[3]) + scalar::size_of(gradient.b[3])) *
                   (extent + 1) <=
               0.25;
  }

  /// Few pixels of the image are listed: so it is not read, and eight are
  /// divided at once, whatever their lines. More than this are not few. Lists
  /// take 8 % off smooth frames of 100,000 small triangles.
  static constexpr int kMostListed = 64;
  static bool are_few(const Target& target, const std::uint32_t* bits) {
    if (target.own) return false;
    int count = 0;
    for (int r = 0; r < kTileHeight; ++r) count += __builtin_popcount(bits[r]);
    return count <= kMostListed;
  }
  static bool shade_blocks(const Target& target, const Gradient& gradient,
                           std::int32_t x, std::int32_t y,
                           const std::uint32_t* bits, std::uint32_t* left) {
    return !are_few(target, bits) &&
           GouraudBlocks::shade_blocks(target, gradient, x, y, bits, left);
  }
  static void shade_lines(const Target& target, const ShadedTile& tile,
                          std::uint32_t rows, const std::uint32_t* bits,
                          std::uint32_t* left) {
    if (are_few(target, bits)) {
      shade_list(target, tile, rows, bits, left);
    } else {
      GouraudLines::shade_lines(target, tile, rows, bits, left);
    }
  }

  /// Colours the pixels `bits` of the lines `rows`; gives those in doubt, a
  /// word a line. Eight are taken at a time, whatever their lines: line by line
  /// most of eight would be outside.
  static void shade_list(const Target& target, const ShadedTile& tile,
                         std::uint32_t rows, const std::uint32_t* bits,
                         std::uint32_t* left) {
    const ListTerms terms(tile);
    // The places of up to eight pixels, a byte each: 32 lines below, 1 column.
    // In a register: where bytes are written one by one and read together, the
    // processor waits.
    std::uint64_t places = 0;
    int count = 0;
    for (; rows != 0; rows &= rows - 1) {
      const int r = __builtin_ctz(rows);
      left[r] = 0;
      std::uint64_t rest = bits[r];
      while (rest != 0) {
        const int first = __builtin_ctzll(rest);
        int run = __builtin_ctzll(~(rest >> first));
        rest &= ~std::uint64_t{0} << (first + run);
        std::uint64_t next =
            0x0706050403020100u +
            static_cast<std::uint64_t>(r * kTileWidth + first) * kEachByte;
        for (; run > 0; run -= 8, next += 8 * kEachByte) {
          const std::uint64_t some =
              run < 8 ? next & ~(~std::uint64_t{0} << (8 * run)) : next;
          places |= some << (8 * count);
          count += run < 8 ? run : 8;
          if (count < 8) continue;
          shade_eight(target, terms, places, 8, left);
          count -= 8;
          const int room = (run < 8 ? run : 8) - count;
          places = room == 8 ? 0 : some >> (8 * room);
        }
      }
    }
    if (count > 0) shade_eight(target, terms, places, count, left);
  }

 private:
  static constexpr std::uint64_t kEachByte = 0x0101010101010101u;

  /// The terms of eight pixels: three of the numerators and the denominator.
  struct ListTerms {
    __m256 from[4];
    __m256 across[4];
    __m256 down[4];
    __m256i first;
    __m256i first_line;
    __m256i doubt;

    explicit ListTerms(const ShadedTile& tile)
        : first(_mm256_set1_epi32(tile.first)),
          first_line(_mm256_set1_epi32(tile.first_line)),
          doubt(_mm256_set1_epi32(tile.doubt)) {
      const auto spread = [](__m128 v, __m256* to) {
        const __m256 both = _mm256_set_m128(v, v);
        to[0] = _mm256_permute_ps(both, 0x00);
        to[1] = _mm256_permute_ps(both, 0x55);
        to[2] = _mm256_permute_ps(both, 0xaa);
        to[3] = _mm256_permute_ps(both, 0xff);
      };
      spread(tile.from, from);
      spread(tile.across, across);
      spread(tile.down, down);
    }
  };

  /// Colours `count` pixels by their places, and enters those in doubt.
  static void shade_eight(const Target& target, const ListTerms& terms,
                          std::uint64_t places, int count,
                          std::uint32_t* left) {
    const __m256i place =
        _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(places)));
    const __m256 x = _mm256_cvtepi32_ps(_mm256_sub_epi32(
        _mm256_and_si256(place, _mm256_set1_epi32(kTileWidth - 1)),
        terms.first));
    const __m256 y = _mm256_cvtepi32_ps(
        _mm256_sub_epi32(_mm256_srli_epi32(place, 5), terms.first_line));
    const auto at = [&](int c) {
      return _mm256_add_ps(
          _mm256_add_ps(terms.from[c], _mm256_mul_ps(terms.across[c], x)),
          _mm256_mul_ps(terms.down[c], y));
    };
    const __m256 reciprocal = _mm256_div_ps(_mm256_set1_ps(1), at(3));
    __m256i levels[3];
    __m256i nearest = _mm256_set1_epi32(-1);
    for (int c = 0; c < 3; ++c) {
      levels[c] = _mm256_cvttps_epi32(_mm256_mul_ps(at(c), reciprocal));
      // The low halves: how far each is above the last step, moved down.
      nearest =
          _mm256_min_epu16(nearest, _mm256_add_epi32(levels[c], terms.doubt));
    }
    const __m256i close = _mm256_cmpgt_epi32(
        _mm256_add_epi32(terms.doubt, terms.doubt),
        _mm256_and_si256(nearest, _mm256_set1_epi32(0xffff)));
    const auto byte = [](__m256i level, int mask) {
      return _mm256_and_si256(level, _mm256_set1_epi32(mask));
    };
    alignas(32) std::uint32_t colors[8];
    store(colors,
          Words8{_mm256_or_si256(
              _mm256_or_si256(byte(_mm256_srli_epi32(levels[0], 16), 0xff),
                              byte(_mm256_srli_epi32(levels[1], 8), 0xff00)),
              byte(levels[2], 0xff0000))});
    std::uint8_t* const to = target.colors + target.at;
    std::uint64_t rest = places;
    for (int p = 0; p < count; ++p, rest >>= 8) {
      const auto at_line = static_cast<std::int64_t>((rest >> 5) & 7u);
      const auto column = static_cast<std::int64_t>(rest & 31u);
      scalar::store_pixel(to + at_line * target.stride + 3 * column, colors[p]);
    }
    auto doubtful = static_cast<std::uint32_t>(
        _mm256_movemask_ps(_mm256_castsi256_ps(close)));
    doubtful &= (1u << count) - 1;
    for (; doubtful != 0; doubtful &= doubtful - 1) {
      const auto p =
          static_cast<std::uint32_t>(places >> (8 * __builtin_ctz(doubtful)));
      left[(p >> 5) & 7u] |= 1u << (p & 31u);
    }
  }

  /// The channels of a corner, and 1.
  static __m256d corner_color(const std::uint8_t* colors, int corner) {
    // The last is read with the byte before it.
    std::uint32_t word;
    __builtin_memcpy(&word, colors + (corner < 2 ? 3 * corner : 5), 4);
    if (corner == 2) word >>= 8;
    word = (word & 0xffffffu) | 0x1000000u;
    return _mm256_cvtepi32_pd(
        _mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(word))));
  }
};

/// What the loops of generic/ take from AVX2 or AVX-512, by what the file that
/// includes this is compiled for: the headers of this folder have unnamed
/// namespaces, so that the two files share no function.
using X86Simd = GouraudSmall;

}  // namespace
}  // namespace halfspace::fast
