#pragma once

#include <immintrin.h>

#include <cstdint>

#include "raster/kernel/tile_view.hpp"
#include "raster/kernel/x86/flat_fill.hpp"

namespace halfspace::fast {
namespace {

/// Smooth colours, line by line.
struct GouraudLines : FlatFill {
  /// The same for all lines of a tile: j lines below line `first_line` n0 and
  /// the denominator have grown by j times `down`.
  struct ShadedTile {
    __m128 from;    ///< three times n0, and 1
    __m128 across;  ///< three times n1, and d
    __m128 down;
    std::int32_t first;
    std::int32_t first_line;
    std::int32_t doubt;
  };

  /// Prepares the pixels `bits` of the lines `rows`; false: they are better
  /// coloured line by line. One preparation for all lines saves 5 to 11 % of
  /// the instructions of smooth frames of small triangles.
  ///
  /// As shade_line(), from the pixel on that is the leftmost of all, in the
  /// first line: with j lines from there and a denominator 1 + d k + d' j. Let
  /// M be |n0| + |n1| k + |n2| j at most, for pixels of the tile, without the
  /// factor 2^16, and 31 |d| + 7 |d'| <= 1/2. The numerator is off by e M from
  /// its coefficients, by e M from the products and by 2 e M from the sums: 8 e
  /// M in the quotient. The denominator is off by e/2 and e/2 for those and 3 e
  /// for the sums, 8 e of itself, so the quotient by 2048 e; its own roundings
  /// add 512 e. With 1 for cutting off that is M / 32 + 11 units of 2^-16; 16
  /// leaves room for what M and the doubles behind are off.
  static bool start_tile(const Gradient& g, std::int32_t x, std::int32_t y,
                         std::uint32_t rows, const std::uint32_t* bits,
                         ShadedTile& tile) {
    std::uint32_t all = 0;
    for (std::int32_t r = 0; r < kTileHeight; ++r) all |= bits[r];
    tile.first = __builtin_ctz(all);
    tile.first_line = __builtin_ctz(rows);
    const __m256d a = _mm256_load_pd(g.a);
    const __m256d b = _mm256_load_pd(g.b);
    const __m256d at = _mm256_add_pd(
        _mm256_mul_pd(a, _mm256_set1_pd(x + tile.first)),
        _mm256_add_pd(_mm256_mul_pd(b, _mm256_set1_pd(y + tile.first_line)),
                      _mm256_load_pd(g.c)));
    const __m256d reciprocal =
        _mm256_div_pd(_mm256_set1_pd(1), _mm256_permute4x64_pd(at, 0xff));
    // A half added to the levels; all times 2^16 but for the denominator.
    const __m256d half = _mm256_setr_pd(0.5, 0.5, 0.5, 0);
    const __m256d unit = _mm256_setr_pd(0x1p16, 0x1p16, 0x1p16, 1);
    const auto with_half = [&](__m256d line) {
      const __m256d ratio = _mm256_mul_pd(line, reciprocal);
      const __m256d shift =
          _mm256_mul_pd(_mm256_permute4x64_pd(ratio, 0xff), half);
      return _mm256_cvtpd_ps(_mm256_mul_pd(_mm256_add_pd(ratio, shift), unit));
    };
    tile.from = with_half(at);
    tile.across = with_half(a);
    tile.down = with_half(b);
    const auto size = [](__m128 v) {
      return _mm_andnot_ps(_mm_set1_ps(-0.0f), v);
    };
    const __m128 range =
        _mm_add_ps(_mm_mul_ps(size(tile.across), _mm_set1_ps(31)),
                   _mm_mul_ps(size(tile.down), _mm_set1_ps(7)));
    alignas(16) float most[4];
    _mm_store_ps(most, _mm_add_ps(size(tile.from), range));
    const double doubt = 2 * 0x1p16 * g.doubt * _mm256_cvtsd_f64(reciprocal);
    float highest = most[0] > most[1] ? most[0] : most[1];
    highest = highest > most[2] ? highest : most[2];
    // A total too small to trust makes it large, or negative, or no number.
    if (!(doubt >= 0 && doubt < 0x1p12) || !(highest < 0x1p29f) ||
        !(most[3] <= 1.5f)) {
      return false;
    }
    tile.doubt = static_cast<std::int32_t>(doubt) +
                 static_cast<std::int32_t>(highest * 0x1p-21f) + 17;
    return true;
  }

  /// The terms of eight pixels of a line.
  struct Shades {
    __m256 n1[3];
    __m256 d;
    __m256i doubt;
    __m256i twice_doubt;
  };

  static Shades shades_of(const float* n1, float d, std::int32_t doubt) {
    return {
        {_mm256_set1_ps(n1[0]), _mm256_set1_ps(n1[1]), _mm256_set1_ps(n1[2])},
        _mm256_set1_ps(d),
        _mm256_set1_epi32(doubt),
        _mm256_set1_epi32(2 * doubt)};
  }

  /// The steps to the 8 pixels from the tile's pixel `k` on.
  static __m256 steps_to(std::int32_t k, std::int32_t first) {
    return _mm256_cvtepi32_ps(
        _mm256_add_epi32(_mm256_set1_epi32(k - first),
                         _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)));
  }

  /// The bytes `kByte` of three channels of 8 pixels, one pixel after another,
  /// in the first 24 bytes.
  template <char kByte>
  static __m256i bytes_of(const __m256i* levels) {
    constexpr char at[4] = {kByte, kByte + 4, kByte + 8, kByte + 12};
    const __m256i red = _mm256_shuffle_epi8(
        levels[0],
        _mm256_setr_epi8(at[0], -1, -1, at[1], -1, -1, at[2], -1, -1, at[3], -1,
                         -1, -1, -1, -1, -1, at[0], -1, -1, at[1], -1, -1,
                         at[2], -1, -1, at[3], -1, -1, -1, -1, -1, -1));
    const __m256i green = _mm256_shuffle_epi8(
        levels[1],
        _mm256_setr_epi8(-1, at[0], -1, -1, at[1], -1, -1, at[2], -1, -1, at[3],
                         -1, -1, -1, -1, -1, -1, at[0], -1, -1, at[1], -1, -1,
                         at[2], -1, -1, at[3], -1, -1, -1, -1, -1));
    const __m256i blue = _mm256_shuffle_epi8(
        levels[2],
        _mm256_setr_epi8(-1, -1, at[0], -1, -1, at[1], -1, -1, at[2], -1, -1,
                         at[3], -1, -1, -1, -1, -1, -1, at[0], -1, -1, at[1],
                         -1, -1, at[2], -1, -1, at[3], -1, -1, -1, -1));
    return _mm256_permutevar8x32_epi32(
        _mm256_or_si256(_mm256_or_si256(red, green), blue),
        _mm256_setr_epi32(0, 1, 2, 4, 5, 6, 3, 7));
  }

  /// The colours of 8 pixels, in the first 24 bytes; gives those in doubt.
  static std::uint32_t eight_colors(const Shades& shades, const __m256* n0,
                                    __m256 d0, __m256 steps, __m256i& colors) {
    const auto along = [steps](__m256 from, __m256 slope) {
      return _mm256_add_ps(from, _mm256_mul_ps(slope, steps));
    };
    const __m256 reciprocal =
        _mm256_div_ps(_mm256_set1_ps(1), along(d0, shades.d));
    __m256i levels[3];
    __m256i nearest = _mm256_set1_epi32(-1);
    for (int c = 0; c < 3; ++c) {
      levels[c] = _mm256_cvttps_epi32(
          _mm256_mul_ps(along(n0[c], shades.n1[c]), reciprocal));
      // The low halves: how far each is above the last step, moved down.
      nearest =
          _mm256_min_epu16(nearest, _mm256_add_epi32(levels[c], shades.doubt));
    }
    const __m256i above = _mm256_and_si256(nearest, _mm256_set1_epi32(0xffff));
    const __m256i close = _mm256_cmpgt_epi32(shades.twice_doubt, above);
    colors = bytes_of<2>(levels);
    return static_cast<std::uint32_t>(
        _mm256_movemask_ps(_mm256_castsi256_ps(close)));
  }

  /// Colours the pixels `bits` of a line of a tile that begins at `to`; gives
  /// those in doubt. `steps` are those to its eights.
  static std::uint32_t shade_eights(const Target& target, std::uint8_t* to,
                                    const Shades& shades, const __m256* n0,
                                    __m256 d0, const __m256* steps,
                                    std::uint32_t bits) {
    std::uint32_t left = 0;
    for (std::int32_t k = 0; k < kTileWidth; k += 8) {
      const std::uint32_t eight = (bits >> k) & 255u;
      if (eight == 0) continue;
      __m256i colors;
      left |= eight_colors(shades, n0, d0, steps[k / 8], colors) << k;
      if (target.loose || (eight == 255u && target.whole)) {
        store_eight(to + 3 * k, colors);
      } else {
        store_some(to + 3 * k, colors, eight,
                   target.whole || (k >= target.first && k + 8 <= target.end));
      }
    }
    return left & bits;
  }

  /// Colours the pixels `bits` of line r; gives those in doubt.
  static std::uint32_t shade_pixels(const Target& target,
                                    const ShadedLine& line, std::int32_t r,
                                    std::uint32_t bits) {
    const Shades shades = shades_of(line.n1, line.d, line.doubt);
    const __m256 n0[3] = {_mm256_set1_ps(line.n0[0]),
                          _mm256_set1_ps(line.n0[1]),
                          _mm256_set1_ps(line.n0[2])};
    const __m256 steps[4] = {steps_to(0, line.first), steps_to(8, line.first),
                             steps_to(16, line.first),
                             steps_to(24, line.first)};
    return shade_eights(target, target.colors + target.at + r * target.stride,
                        shades, n0, _mm256_set1_ps(line.d0), steps, bits);
  }

  /// Colours the pixels `bits` of the lines `rows`; gives those in doubt, a
  /// word a line.
  static void shade_lines(const Target& target, const ShadedTile& tile,
                          std::uint32_t rows, const std::uint32_t* bits,
                          std::uint32_t* left) {
    alignas(16) float across[4];
    _mm_store_ps(across, tile.across);
    const Shades shades = shades_of(across, across[3], tile.doubt);
    const __m256 steps[4] = {steps_to(0, tile.first), steps_to(8, tile.first),
                             steps_to(16, tile.first),
                             steps_to(24, tile.first)};
    for (; rows != 0; rows &= rows - 1) {
      const std::int32_t r = __builtin_ctz(rows);
      const __m128 lines = _mm_set1_ps(static_cast<float>(r - tile.first_line));
      const __m128 from = _mm_add_ps(tile.from, _mm_mul_ps(tile.down, lines));
      const __m256 all = _mm256_set_m128(from, from);
      const __m256 n0[3] = {_mm256_permute_ps(all, 0x00),
                            _mm256_permute_ps(all, 0x55),
                            _mm256_permute_ps(all, 0xaa)};
      left[r] = shade_eights(
          target, target.colors + target.at + r * target.stride, shades, n0,
          _mm256_permute_ps(all, 0xff), steps, bits[r]);
    }
  }
};

}  // namespace
}  // namespace halfspace::fast
