#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {
namespace {

/// Means of samples, as ColorMeans and PixelGradient have them: four pixels at
/// once, or four functions.
struct PixelMeans {
  static __m256d broadcast(double v) { return _mm256_set1_pd(v); }
  static __m256d size_of(__m256d v) {
    return _mm256_andnot_pd(broadcast(-0.0), v);
  }

  /// Of `count` pixels that see one polygon, from sample (i, j) on; returns how
  /// many of them, from the first on, are decided.
  static std::int32_t full_means(const Gradient& gradient, std::int32_t samples,
                                 std::int32_t i, std::int32_t j,
                                 std::int32_t count, std::uint8_t* means) {
    switch (samples) {
      case 2:
        return full_means<2>(gradient, i, j, count, means);
      case 4:
        return full_means<4>(gradient, i, j, count, means);
      default:
        return full_means<8>(gradient, i, j, count, means);
    }
  }

  /// Of a pixel with some samples in each part, and others of colours that are
  /// added up in `whole`; false where that does not decide.
  static bool mixed_mean(const MeanPart* parts, std::int32_t part_count,
                         const std::int32_t* whole, std::int32_t samples,
                         std::int32_t i, std::int32_t j, std::uint8_t* mean) {
    const double middle = 0.5 * (samples - 1);
    __m256d sum = _mm256_cvtepi32_pd(
        _mm_loadu_si128(reinterpret_cast<const __m128i*>(whole)));
    double doubt = 0;
    bool usable = true;
    for (std::int32_t p = 0; p < part_count; ++p) {
      usable =
          add(parts[p], i + middle, j + middle, samples - 1.0, sum, doubt) &&
          usable;
    }
    if (part_count > 0) doubt += 0x1p-30;
    const double count = samples * samples;
    if (!(usable && doubt < count / 4)) return false;
    __m128i level;
    if ((decided(sum, broadcast(doubt), count, level) & 7) != 7) return false;
    write(static_cast<std::uint32_t>(_mm_extract_epi32(level, 0)) |
              static_cast<std::uint32_t>(_mm_extract_epi32(level, 1)) << 8 |
              static_cast<std::uint32_t>(_mm_extract_epi32(level, 2)) << 16,
          mean);
    return true;
  }

 private:
  static void write(std::uint32_t color, std::uint8_t* to) {
    to[0] = static_cast<std::uint8_t>(color);
    to[1] = static_cast<std::uint8_t>(color >> 8);
    to[2] = static_cast<std::uint8_t>(color >> 16);
  }

  /// rounded_mean() of four sums: the bits of those that are decided.
  static int decided(__m256d sum, __m256d doubt, double count, __m128i& level) {
    const __m256d value = _mm256_add_pd(sum, broadcast(count / 2));
    level = _mm256_cvttpd_epi32(_mm256_mul_pd(value, broadcast(1 / count)));
    const __m256d above = _mm256_sub_pd(
        value, _mm256_mul_pd(_mm256_cvtepi32_pd(level), broadcast(count)));
    const __m256d most = _mm256_sub_pd(broadcast(count), doubt);
    return _mm256_movemask_pd(
        _mm256_and_pd(_mm256_cmp_pd(above, doubt, _CMP_GE_OQ),
                      _mm256_cmp_pd(above, most, _CMP_LT_OQ)));
  }

  /// PixelGradient::add(), the channels and the total in one register.
  static bool add(const MeanPart& part, double u, double v, double reach,
                  __m256d& sum, double& doubt) {
    const Gradient& g = *part.gradient;
    const Moments& m = part.moments;
    const __m256d a = _mm256_load_pd(g.a);
    const __m256d b = _mm256_load_pd(g.b);
    const __m256d n = _mm256_add_pd(
        _mm256_mul_pd(a, broadcast(u)),
        _mm256_add_pd(_mm256_mul_pd(b, broadcast(v)), _mm256_load_pd(g.c)));
    const auto total = [](__m256d f) { return _mm256_permute4x64_pd(f, 0xff); };
    const __m256d reciprocal = _mm256_div_pd(broadcast(1), total(n));
    const __m256d half = _mm256_mul_pd(broadcast(0.5), reciprocal);
    const __m256d e_x = _mm256_mul_pd(total(a), half);
    const __m256d e_y = _mm256_mul_pd(total(b), half);
    const __m256d s = _mm256_mul_pd(n, reciprocal);
    const __m256d x =
        _mm256_mul_pd(_mm256_sub_pd(a, _mm256_mul_pd(s, total(a))), half);
    const __m256d y =
        _mm256_mul_pd(_mm256_sub_pd(b, _mm256_mul_pd(s, total(b))), half);
    const auto times = [](__m256d f, std::int32_t k) {
      return _mm256_mul_pd(f, broadcast(k));
    };
    const __m256d linear = _mm256_add_pd(times(x, m.x), times(y, m.y));
    const __m256d square = _mm256_add_pd(
        _mm256_mul_pd(x, _mm256_add_pd(times(e_x, m.xx), times(e_y, m.xy))),
        _mm256_mul_pd(y, _mm256_add_pd(times(e_x, m.xy), times(e_y, m.yy))));
    sum = _mm256_add_pd(
        sum, _mm256_sub_pd(_mm256_add_pd(times(s, m.n), linear), square));
    const __m256d size =
        _mm256_mul_pd(_mm256_add_pd(size_of(x), size_of(y)), broadcast(reach));
    const __m256d small =
        _mm256_and_pd(_mm256_cmp_pd(size_of(s), broadcast(512), _CMP_LE_OQ),
                      _mm256_cmp_pd(size, broadcast(256), _CMP_LE_OQ));
    const __m128d first = _mm256_castpd256_pd128(size);
    const double most = _mm_cvtsd_f64(
        _mm_max_sd(_mm_max_sd(first, _mm_unpackhi_pd(first, first)),
                   _mm256_extractf128_pd(size, 1)));
    const double e =
        _mm256_cvtsd_f64(_mm256_add_pd(size_of(e_x), size_of(e_y))) * reach;
    const double own = g.doubt * _mm256_cvtsd_f64(reciprocal);
    doubt += m.n * (5 * own + 0x1p-38 + 4.0 / 3 * most * (e * e));
    return (_mm256_movemask_pd(small) & 7) == 7 && e <= 0.25 && own >= 0 &&
           own < 1;
  }

  /// PixelGradient::add_all() and rounded_mean().
  template <std::int32_t kSamples>
  static std::int32_t full_means(const Gradient& gradient, std::int32_t i,
                                 std::int32_t j, std::int32_t count,
                                 std::uint8_t* means) {
    constexpr double kCount = kSamples * kSamples;
    constexpr double kSquares =
        kSamples * kSamples * (kSamples * kSamples - 1) / 3;
    constexpr double kMiddle = 0.5 * (kSamples - 1);
    constexpr double kReach = kSamples - 1;
    const Gradient& g = gradient;
    const double v = j + kMiddle;
    __m256d at[4];
    for (int f = 0; f < 4; ++f) at[f] = broadcast(g.b[f] * v + g.c[f]);
    __m256d u =
        _mm256_add_pd(broadcast(i + kMiddle),
                      _mm256_set_pd(3 * kSamples, 2 * kSamples, kSamples, 0));
    for (std::int32_t k = 0; k < count; k += 4) {
      const __m256d total =
          _mm256_add_pd(_mm256_mul_pd(broadcast(g.a[3]), u), at[3]);
      const __m256d reciprocal = _mm256_div_pd(broadcast(1), total);
      const __m256d half = _mm256_mul_pd(broadcast(0.5), reciprocal);
      const __m256d e_x = _mm256_mul_pd(broadcast(g.a[3]), half);
      const __m256d e_y = _mm256_mul_pd(broadcast(g.b[3]), half);
      const __m256d e = _mm256_mul_pd(_mm256_add_pd(size_of(e_x), size_of(e_y)),
                                      broadcast(kReach));
      const __m256d own = _mm256_mul_pd(broadcast(g.doubt), reciprocal);
      __m256d usable = _mm256_and_pd(
          _mm256_cmp_pd(e, broadcast(0.25), _CMP_LE_OQ),
          _mm256_and_pd(_mm256_cmp_pd(own, broadcast(0), _CMP_GE_OQ),
                        _mm256_cmp_pd(own, broadcast(1), _CMP_LT_OQ)));
      __m256d most = _mm256_setzero_pd();
      __m256d sum[3];
      for (int c = 0; c < 3; ++c) {
        const __m256d s = _mm256_mul_pd(
            _mm256_add_pd(_mm256_mul_pd(broadcast(g.a[c]), u), at[c]),
            reciprocal);
        const __m256d x =
            _mm256_mul_pd(_mm256_sub_pd(broadcast(g.a[c]),
                                        _mm256_mul_pd(s, broadcast(g.a[3]))),
                          half);
        const __m256d y =
            _mm256_mul_pd(_mm256_sub_pd(broadcast(g.b[c]),
                                        _mm256_mul_pd(s, broadcast(g.b[3]))),
                          half);
        const __m256d size = _mm256_mul_pd(
            _mm256_add_pd(size_of(x), size_of(y)), broadcast(kReach));
        most = _mm256_max_pd(most, size);
        usable = _mm256_and_pd(
            usable,
            _mm256_and_pd(_mm256_cmp_pd(size_of(s), broadcast(512), _CMP_LE_OQ),
                          _mm256_cmp_pd(size, broadcast(256), _CMP_LE_OQ)));
        const __m256d square =
            _mm256_add_pd(_mm256_mul_pd(x, e_x), _mm256_mul_pd(y, e_y));
        sum[c] = _mm256_sub_pd(_mm256_mul_pd(broadcast(kCount), s),
                               _mm256_mul_pd(broadcast(kSquares), square));
      }
      const __m256d cube = _mm256_mul_pd(e, _mm256_mul_pd(e, e));
      const __m256d each = _mm256_add_pd(
          _mm256_add_pd(_mm256_mul_pd(broadcast(5), own), broadcast(0x1p-38)),
          _mm256_mul_pd(broadcast(4.0 / 3), _mm256_mul_pd(most, cube)));
      const __m256d doubt = _mm256_add_pd(
          _mm256_mul_pd(broadcast(kCount), each), broadcast(0x1p-30));
      int known = _mm256_movemask_pd(usable);
      __m128i level[3];
      for (int c = 0; c < 3; ++c)
        known &= decided(sum[c], doubt, kCount, level[c]);
      const __m128i colors =
          _mm_or_si128(level[0], _mm_or_si128(_mm_slli_epi32(level[1], 8),
                                              _mm_slli_epi32(level[2], 16)));
      std::uint32_t four[4];
      _mm_storeu_si128(reinterpret_cast<__m128i*>(four), colors);
      for (std::int32_t n = 0; n < 4; ++n) {
        if (k + n == count) return count;
        if ((known >> n & 1) == 0) return k + n;
        write(four[n], means + 3 * (k + n));
      }
      u = _mm256_add_pd(u, broadcast(4 * kSamples));
    }
    return count;
  }
};

/// The table, with means.
constexpr TileKernel with_means(TileKernel kernel) {
  kernel.full_means = PixelMeans::full_means;
  kernel.mixed_mean = PixelMeans::mixed_mean;
  return kernel;
}

}  // namespace
}  // namespace halfspace::fast
