#pragma once

#include <cstdint>

#include "raster/kernel/generic/scalar.hpp"
#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {

/// Smooth colours of a tile.
template <class Simd>
struct Shade : Simd {
  using Simd::shade_blocks, Simd::shade_lines, Simd::shade_pixels;
  using Simd::start_tile;
  using typename Simd::ShadedTile;

  /// Colours the pixels `bits` of line r of the tile with the left top pixel
  /// (x, y) by the gradient; gives those that are left to be decided one by
  /// one.
  ///
  /// From the first of the pixels on, at u, with k counting pixels from there
  /// and T the total at u: the value and a half is (n0 + n1 k) / (1 + d k),
  /// with n0 = S / T + 1/2, n1 = S' / T + d / 2, d = T' / T, S' and T' the
  /// slopes; here in floats, times 2^16, to be cut to integers whose third byte
  /// is the level. Let e = 2^-24 and |31 d| <= 1/2. The denominator is at least
  /// 1/2 and off by k |d| e from d, as much from the product, and 1.5 e from
  /// the sum: 5 e of itself. At the pixels that matter the value and a half is
  /// from 1/2 to 255.5, so the numerator is at most 384, and n1 k at most 640:
  /// off by e (256 + 640 + 640 + 384) from n0, n1, the product and the sum,
  /// twice that in the quotient: 3840 e. The quotient adds 256 (5 + 2) e with
  /// the reciprocal's and the product's rounding. So 5632 e, 22 units of 2^-16,
  /// one more for cutting off; 28 leaves room for what the doubles behind n0,
  /// n1 and d are off beside `doubt`. That counts twice, as the total may be
  /// half of T.
  static std::uint32_t shade_line(const Target& target, const Gradient& g,
                                  std::int32_t x, std::int32_t y,
                                  std::int32_t r, std::uint32_t bits) {
    const std::int32_t first = __builtin_ctz(bits);
    const double u = x + first;
    const double v = y + r;
    const double reciprocal = 1 / (g.a[3] * u + (g.b[3] * v + g.c[3]));
    const double d = g.a[3] * reciprocal;
    const double doubt = 2 * 0x1p16 * g.doubt * reciprocal;
    // A total too small to trust makes it large, or negative, or no number.
    if (!(doubt >= 0 && doubt < 0x1p12) || !(scalar::size_of(d) * 31 <= 0.5)) {
      return bits;
    }
    ShadedLine line;
    line.first = first;
    line.d0 = 1;
    line.d = static_cast<float>(d);
    line.doubt = static_cast<std::int32_t>(doubt) + 29;
    for (int c = 0; c < 3; ++c) {
      const double s = g.a[c] * u + (g.b[c] * v + g.c[c]);
      line.n0[c] = static_cast<float>(0x1p16 * (s * reciprocal + 0.5));
      line.n1[c] = static_cast<float>(0x1p16 * (g.a[c] * reciprocal + 0.5 * d));
    }
    return shade_pixels(target, line, r, bits);
  }

  /// Colours the pixels `bits` of the lines `rows` of a tile by the gradient.
  static void put_smooth(const Target& target, std::int32_t x, std::int32_t y,
                         std::uint32_t rows, const std::uint32_t* bits,
                         const PixelSource& source, const Gradient& gradient,
                         ExactFallback& exact) {
    alignas(32) std::uint32_t left[kTileHeight];
    ShadedTile tile;
    if (shade_blocks(target, gradient, x, y, bits, left)) {
      // Done but for those.
    } else if (start_tile(gradient, x, y, rows, bits, tile)) {
      shade_lines(target, tile, rows, bits, left);
    } else {
      for (std::uint32_t rest = rows; rest != 0; rest &= rest - 1) {
        const std::int32_t r = __builtin_ctz(rest);
        left[r] = shade_line(target, gradient, x, y, r, bits[r]);
      }
    }
    for (; rows != 0; rows &= rows - 1) {
      const std::int32_t r = __builtin_ctz(rows);
      if (left[r] == 0) continue;
      exact.shade(source, x, y + r, left[r], target.colors,
                  target.at + r * target.stride);
    }
  }
};

}  // namespace halfspace::fast
