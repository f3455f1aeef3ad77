#pragma once

#include <immintrin.h>

#include <cstdint>

#include "raster/kernel/x86/gouraud_lines.hpp"

namespace halfspace::fast {
namespace {

/// Smooth colours of many pixels, in blocks of 8 x 8.
struct GouraudBlocks : GouraudLines {
  /// The levels in blocks of 8 x 8 pixels, four side by side: at column i and
  /// line r of a block, in units of 2^-24 and modulo 2^32,
  /// t[0] + t[1] i + t[2] r + t[3] i i + t[4] i r + t[5] r r.
  struct ShadedBlocks {
    /// A channel's terms, each for four blocks: the low words of doubles.
    alignas(32) double terms[3][6][4];
    alignas(16) std::int32_t twice_doubt[4];
  };

  /// Beyond this doubt dividing is faster than deciding pixels one by one.
  /// Units: 2^-24.
  static constexpr double kMostBlockDoubt = 0x1p15;

  /// Gets ready for four blocks from (x, y) on; false: for one of the `needed`
  /// (a bit each) this is too little.
  ///
  /// From a block's centre on, at (u, v), let the total be T (1 + q) with
  /// q = p u + s v. A sum over it is f + l / (1 + q), f at the centre and
  /// l = g u + h v, g being the slope of the sum over T less f p, h the same:
  /// so it is f + l - l q, off by l q q / (1 + q). With |u|, |v| <= 7/2, |l| <=
  /// L = 7/2 (|g| + |h|), |q| <= Q = 7/2 (|p| + |s|) <= 1/4 that is at most 4/3
  /// L Q Q. The terms in i = u + 7/2 and r = v + 7/2 are rounded to units, by
  /// half of one each: (1 + 7 + 7 + 49 + 49 + 49) / 2 = 81 of them in the sum.
  /// The doubles' errors, in levels of at most 2^12, are far below a unit; 90
  /// leaves room for them. `doubt` counts twice, as the total may be 3/4 of T.
  /// All that is added to a level and a half: the level is right where its
  /// fraction is no less than twice that.
  static bool start_blocks(const Gradient& g, std::int32_t x, std::int32_t y,
                           std::uint32_t needed, ShadedBlocks& blocks) {
    const auto all = [](double d) { return _mm256_set1_pd(d); };
    const auto product = [](__m256d a, __m256d b) {
      return _mm256_mul_pd(a, b);
    };
    const auto sum = [](__m256d a, __m256d b) { return _mm256_add_pd(a, b); };
    const auto sizes = [&](__m256d a, __m256d b) {
      const __m256d sign = all(-0.0);
      return product(all(3.5),
                     sum(_mm256_andnot_pd(sign, a), _mm256_andnot_pd(sign, b)));
    };
    const __m256d u = sum(all(x), _mm256_setr_pd(3.5, 11.5, 19.5, 27.5));
    const auto at = [&](int f) {
      return sum(product(all(g.a[f]), u), all(g.b[f] * (y + 3.5) + g.c[f]));
    };
    const __m256d reciprocal = _mm256_div_pd(all(1), at(3));
    const __m256d p = product(all(g.a[3]), reciprocal);
    const __m256d s = product(all(g.b[3]), reciprocal);
    const __m256d q = sizes(p, s);
    __m256d level[3], across[3], down[3];
    __m256d steepest = all(0);
    __m256d highest = all(0);
    for (int c = 0; c < 3; ++c) {
      level[c] = product(at(c), reciprocal);
      across[c] =
          _mm256_sub_pd(product(all(g.a[c]), reciprocal), product(level[c], p));
      down[c] =
          _mm256_sub_pd(product(all(g.b[c]), reciprocal), product(level[c], s));
      steepest = _mm256_max_pd(steepest, sizes(across[c], down[c]));
      highest = _mm256_max_pd(highest, _mm256_andnot_pd(all(-0.0), level[c]));
    }
    const __m256d curved =
        product(product(all(1.34 * 0x1p24), steepest), product(q, q));
    const __m256d doubt = sum(
        sum(product(all(2 * 0x1p24 * g.doubt), reciprocal), curved), all(90));
    // A total too small to trust makes its doubt large, or negative, or no
    // number.
    const auto less = [](__m256d a, __m256d b) {
      return _mm256_cmp_pd(a, b, _CMP_LE_OQ);
    };
    const __m256d good = _mm256_and_pd(
        _mm256_and_pd(less(all(0), reciprocal), less(q, all(0.25))),
        _mm256_and_pd(less(doubt, all(kMostBlockDoubt)),
                      less(sum(highest, steepest), all(0x1p12))));
    const auto usable = static_cast<std::uint32_t>(_mm256_movemask_pd(good));
    if ((needed & ~usable) != 0) return false;
    _mm_store_si128(reinterpret_cast<__m128i*>(blocks.twice_doubt),
                    _mm256_cvttpd_epi32(sum(product(doubt, all(2)), all(1))));
    for (int c = 0; c < 3; ++c) {
      // Rounds to units: they are then the lowest bits.
      const auto put = [&](int term, __m256d value, __m256d more) {
        _mm256_store_pd(
            blocks.terms[c][term],
            sum(sum(product(value, all(0x1p24)), more), all(0x1.8p52)));
      };
      const __m256d zero = all(0);
      const __m256d ii = _mm256_sub_pd(zero, product(across[c], p));
      const __m256d rr = _mm256_sub_pd(zero, product(down[c], s));
      const __m256d ir =
          _mm256_sub_pd(zero, sum(product(across[c], s), product(down[c], p)));
      const __m256d shift = product(all(3.5), ir);
      put(5, rr, zero);
      put(4, ir, zero);
      put(3, ii, zero);
      put(2, _mm256_sub_pd(down[c], sum(product(all(7), rr), shift)), zero);
      put(1, _mm256_sub_pd(across[c], sum(product(all(7), ii), shift)), zero);
      const __m256d corner =
          _mm256_sub_pd(product(all(12.25), sum(ii, sum(ir, rr))),
                        product(all(3.5), sum(across[c], down[c])));
      put(0, sum(sum(level[c], all(0.5)), corner), doubt);
    }
    return true;
  }

  using GouraudLines::shade_lines;

  /// A line of a block, and what leads to the next.
  struct BlockLine {
    __m256i level[3];
    __m256i step[3];
    __m256i bend[3];

    BlockLine(const ShadedBlocks& blocks, int block) {
      const __m256i i = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
      const __m256i ii = _mm256_setr_epi32(0, 1, 4, 9, 16, 25, 36, 49);
      for (int c = 0; c < 3; ++c) {
        const auto term = [&](int k) {
          std::int32_t low;
          __builtin_memcpy(&low, &blocks.terms[c][k][block], 4);
          return _mm256_set1_epi32(low);
        };
        level[c] = _mm256_add_epi32(
            _mm256_add_epi32(term(0), _mm256_mullo_epi32(term(1), i)),
            _mm256_mullo_epi32(term(3), ii));
        const __m256i rr = term(5);
        step[c] = _mm256_add_epi32(_mm256_add_epi32(term(2), rr),
                                   _mm256_mullo_epi32(term(4), i));
        bend[c] = _mm256_add_epi32(rr, rr);
      }
    }

    void next() {
      for (int c = 0; c < 3; ++c) {
        level[c] = _mm256_add_epi32(level[c], step[c]);
        step[c] = _mm256_add_epi32(step[c], bend[c]);
      }
    }

    /// The least of what the channels' levels have left, in units of 2^-32.
    __m256i least_left() const {
      const auto left = [this](int c) {
        return _mm256_slli_epi32(level[c], 8);
      };
      return _mm256_min_epu32(_mm256_min_epu32(left(0), left(1)), left(2));
    }

    __m256i colors() const { return bytes_of<3>(level); }
  };

  /// Where what levels have left is too little to decide them.
  static std::uint32_t in_doubt(const ShadedBlocks& blocks, int block,
                                __m256i left) {
    const __m256i most =
        _mm256_set1_epi32((blocks.twice_doubt[block] << 8) - 1);
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(
        _mm256_cmpeq_epi32(_mm256_min_epu32(left, most), left))));
  }

  /// Colours all of a block; gives the least of what its levels have left.
  /// `on`: the 8 bytes to its right may be written over.
  static __m256i shade_all(std::uint8_t* to, std::int64_t stride, bool on,
                           BlockLine line) {
    __m256i least = line.least_left();
    for (int r = 0; r < kTileHeight; ++r, to += stride, line.next()) {
      least = _mm256_min_epu32(least, line.least_left());
      if (on) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), line.colors());
      } else {
        store_eight(to, line.colors());
      }
    }
    return least;
  }

  /// Colours the pixels `bits` of a block, whose first column is `shift`,
  /// and writes the others again as they were.
  static __m256i shade_own(std::uint8_t* to, std::int64_t stride,
                           const std::uint32_t* bits, int shift,
                           BlockLine line) {
    __m256i least = line.least_left();
    for (int r = 0; r < kTileHeight; ++r, to += stride, line.next()) {
      least = _mm256_min_epu32(least, line.least_left());
      store_some(to, line.colors(), (bits[r] >> shift) & 255u, true);
    }
    return least;
  }

  /// Colours the pixels `bits` of a block, one line or another.
  static __m256i shade_lines(const Target& target, std::uint8_t* to,
                             const std::uint32_t* bits, int shift,
                             BlockLine line) {
    const bool whole =
        target.whole || (shift >= target.first && shift + 8 <= target.end);
    __m256i least = _mm256_set1_epi32(-1);
    for (int r = 0; r < kTileHeight; ++r, to += target.stride, line.next()) {
      const std::uint32_t eight = (bits[r] >> shift) & 255u;
      if (eight == 0) continue;
      least = _mm256_min_epu32(least, line.least_left());
      store_some(to, line.colors(), eight, whole);
    }
    return least;
  }

  /// Colours the pixels `bits` of a block; adds those in doubt to `left`.
  /// `all`: all of the tile may be written over, block after block.
  static void shade_block(const Target& target, const ShadedBlocks& blocks,
                          int block, bool all, const std::uint32_t* bits,
                          std::uint32_t* left) {
    const int shift = 8 * block;
    std::uint8_t* to = target.colors + target.at + 3 * shift;
    const BlockLine first(blocks, block);
    const __m256i least = all ? shade_all(to, target.stride, block < 3, first)
                          : target.own
                              ? shade_own(to, target.stride, bits, shift, first)
                              : shade_lines(target, to, bits, shift, first);
    if (in_doubt(blocks, block, least) == 0) return;
    BlockLine line = first;
    for (int r = 0; r < kTileHeight; ++r, line.next()) {
      left[r] |=
          (in_doubt(blocks, block, line.least_left()) << shift) & bits[r];
    }
  }

  /// Colours the pixels `bits` of the blocks `needed` (a bit each); adds those
  /// in doubt to `left`. `all`: all of the tile may be written over, from left
  /// to right.
  static void shade_needed(const Target& target, const ShadedBlocks& blocks,
                           std::uint32_t needed, bool all,
                           const std::uint32_t* bits, std::uint32_t* left) {
    for (int b = 0; b < 4; ++b) {
      if (((needed >> b) & 1u) != 0) {
        shade_block(target, blocks, b, all, bits, left);
      }
    }
  }

  /// Fewer eights of pixels are faster divided. Without blocks smooth frames of
  /// large triangles take 14 to 16 % more instructions.
  static constexpr int kFewEights = 8;

  /// Colours the pixels `bits` of a tile by the gradient and gives those in
  /// doubt; false: nothing is done.
  static bool shade_blocks(const Target& target, const Gradient& gradient,
                           std::int32_t x, std::int32_t y,
                           const std::uint32_t* bits, std::uint32_t* left) {
    const __m256i pixels = load(bits).bits;
    const __m256i zero = _mm256_setzero_si256();
    const auto empty = static_cast<std::uint32_t>(
        _mm256_movemask_epi8(_mm256_cmpeq_epi8(pixels, zero)));
    if (__builtin_popcount(~empty) < kFewEights) return false;
    std::uint32_t needed = ~empty;
    needed |= needed >> 16;
    needed |= needed >> 8;
    needed = (needed | needed >> 4) & 15u;
    ShadedBlocks blocks;
    if (!start_blocks(gradient, x, y, needed, blocks)) return false;
    store(left, none());
    const bool all_of_it =
        target.loose || (target.whole && all(Words8{pixels}));
    shade_needed(target, blocks, needed, all_of_it, bits, left);
    return true;
  }
};

}  // namespace
}  // namespace halfspace::fast
