#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {

/// Boxes of subtrees, against the tiles that are lit.
template <class Base>
struct BoxTest : Base {
  using Base::any_unlit;

  /// An affine function at the eight corners of a box.
  static __m256 at_corners(const float* f, __m256 x, __m256 y, __m256 z) {
    const auto times = [](float a, __m256 b) {
      return _mm256_mul_ps(_mm256_set1_ps(a), b);
    };
    const __m256 first = _mm256_add_ps(times(f[2], z), _mm256_set1_ps(f[3]));
    return _mm256_add_ps(times(f[0], x), _mm256_add_ps(times(f[1], y), first));
  }

  /// The least of each of four.
  static __m128 least_of(__m256 a, __m256 b, __m256 c, __m256 d) {
    const auto half = [](__m256 v) {
      return _mm_min_ps(_mm256_castps256_ps128(v), _mm256_extractf128_ps(v, 1));
    };
    const auto both = [](__m128 v, __m128 w) {
      return _mm_min_ps(_mm_unpacklo_ps(v, w), _mm_unpackhi_ps(v, w));
    };
    const __m128 first = both(half(a), half(b));
    const __m128 second = both(half(c), half(d));
    return _mm_min_ps(_mm_movelh_ps(first, second),
                      _mm_movehl_ps(second, first));
  }

  /// A box's low end along an axis, in the lanes of the mask the high one.
  template <int kMask>
  static __m256 ends_of(const Box& box, std::size_t axis) {
    return _mm256_blend_ps(_mm256_set1_ps(box.low[axis]),
                           _mm256_set1_ps(box.high[axis]), kMask);
  }

  static BoxVisibility box_visibility(const TileView& screen,
                                      const BoxView& view, const Box& box) {
    const __m256 vx = ends_of<0xaa>(box, 0);
    const __m256 vy = ends_of<0xcc>(box, 1);
    const __m256 vz = ends_of<0xf0>(box, 2);
    const __m256 t = at_corners(view.t, vx, vy, vz);
    const __m256 far = _mm256_cmp_ps(t, _mm256_set1_ps(view.least), _CMP_GT_OQ);
    if (_mm256_movemask_ps(far) != 255) return BoxVisibility::kUnknown;
    const __m256 reciprocal = _mm256_div_ps(_mm256_set1_ps(1), t);
    const __m256 x = _mm256_mul_ps(at_corners(view.x, vx, vy, vz), reciprocal);
    const __m256 y = _mm256_mul_ps(at_corners(view.y, vx, vy, vz), reciprocal);
    const __m256 sign = _mm256_set1_ps(-0.0f);
    // From the least x and y on, up to the greatest, which are negative here.
    const __m128 reach = _mm_sub_ps(
        least_of(x, y, _mm256_xor_ps(x, sign), _mm256_xor_ps(y, sign)),
        _mm_set1_ps(0.6f));
    const __m128 limits = _mm_setr_ps(static_cast<float>(screen.columns.first),
                                      static_cast<float>(screen.lines.first),
                                      static_cast<float>(screen.columns.end),
                                      static_cast<float>(screen.lines.end));
    const __m128 within = _mm_ceil_ps(reach);
    // The first pixel is at least that of the screen, the end at most.
    const __m128 first = _mm_max_ps(within, limits);
    const __m128 end = _mm_min_ps(
        _mm_xor_ps(_mm_movehl_ps(within, within), _mm_set1_ps(-0.0f)),
        _mm_movehl_ps(limits, limits));
    if ((_mm_movemask_ps(_mm_cmplt_ps(first, end)) & 3) != 3) {
      return BoxVisibility::kHidden;
    }
    const __m128i pixels = _mm_cvttps_epi32(_mm_movelh_ps(first, end));
    alignas(16) std::int32_t found[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(found), pixels);
    return any_unlit(screen, {found[0], found[2]}, {found[1], found[3]})
               ? BoxVisibility::kVisible
               : BoxVisibility::kHidden;
  }
};

}  // namespace halfspace::fast
