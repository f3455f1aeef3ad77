#pragma once

#include <immintrin.h>

#include <cstdint>

#include "camera/edge_function.hpp"
#include "raster/kernel/generic/eight_doubles.hpp"

namespace halfspace::fast {
namespace {

struct Lanes {
  static constexpr int kCount = 4;
  __m256d v;
};
/// Where something holds: all bits of a lane, or none.
struct LaneMask {
  __m256d v;
};
inline Lanes operator+(Lanes a, Lanes b) { return {_mm256_add_pd(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_pd(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm256_mul_pd(a.v, b.v)}; }
inline Lanes operator/(Lanes a, Lanes b) { return {_mm256_div_pd(a.v, b.v)}; }

inline LaneMask operator<(Lanes a, Lanes b) {
  return {_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)};
}
inline LaneMask operator&(LaneMask a, LaneMask b) {
  return {_mm256_and_pd(a.v, b.v)};
}
inline LaneMask operator|(LaneMask a, LaneMask b) {
  return {_mm256_or_pd(a.v, b.v)};
}

using Doubles8 = EightDoubles<Lanes>;

/// Eight floats: one for each of 8 lines, or of 8 polygons.
struct Floats8 {
  __m256 v;
};
/// Where something holds of them.
struct FloatMask {
  __m256 v;
};
inline FloatMask operator<(Floats8 a, Floats8 b) {
  return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)};
}
inline FloatMask operator&(FloatMask a, FloatMask b) {
  return {_mm256_and_ps(a.v, b.v)};
}
inline FloatMask operator|(FloatMask a, FloatMask b) {
  return {_mm256_or_ps(a.v, b.v)};
}
inline FloatMask operator^(FloatMask a, FloatMask b) {
  return {_mm256_xor_ps(a.v, b.v)};
}

/// One word for each of 8 lines.
struct Words8 {
  __m256i bits;
};

inline Words8 operator&(Words8 a, Words8 b) {
  return {_mm256_and_si256(a.bits, b.bits)};
}
inline Words8 operator|(Words8 a, Words8 b) {
  return {_mm256_or_si256(a.bits, b.bits)};
}
inline Floats8 operator+(Floats8 a, Floats8 b) {
  return {_mm256_add_ps(a.v, b.v)};
}
inline Floats8 operator-(Floats8 a, Floats8 b) {
  return {_mm256_sub_ps(a.v, b.v)};
}
inline Floats8 operator*(Floats8 a, Floats8 b) {
  return {_mm256_mul_ps(a.v, b.v)};
}
inline Floats8 operator/(Floats8 a, Floats8 b) {
  return {_mm256_div_ps(a.v, b.v)};
}

/// Registers of 256 bits: four doubles, eight floats, eight words. For AVX-512,
/// too: loops with registers of 512 bits took 3 to 6 % longer.
struct LaneRegisters {
  using Lanes = fast::Lanes;
  using LaneMask = fast::LaneMask;
  using Doubles8 = fast::Doubles8;
  using Floats8 = fast::Floats8;
  using FloatMask = fast::FloatMask;
  using Words8 = fast::Words8;

  static Lanes lanes(double v) { return {_mm256_set1_pd(v)}; }
  static Lanes count_from(double v) {
    return {_mm256_add_pd(_mm256_set1_pd(v), _mm256_setr_pd(0, 1, 2, 3))};
  }
  static Lanes widened(const float* p) {
    return {_mm256_cvtps_pd(_mm_load_ps(p))};
  }
  static Lanes widened(const std::int32_t* p) {
    return {_mm256_cvtepi32_pd(
        _mm_load_si128(reinterpret_cast<const __m128i*>(p)))};
  }
  static Lanes greater(Lanes a, Lanes b) { return {_mm256_max_pd(a.v, b.v)}; }
  static Lanes smaller(Lanes a, Lanes b) { return {_mm256_min_pd(a.v, b.v)}; }
  static Lanes size_of(Lanes a) {
    return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v)};
  }
  static Lanes ceiling(Lanes a) { return {_mm256_ceil_pd(a.v)}; }
  static Lanes first_centre(Lanes a) { return ceiling(a - lanes(0.5)); }
  /// Rounded towards zero.
  static void store(std::int32_t* p, Lanes a) {
    _mm_store_si128(reinterpret_cast<__m128i*>(p), _mm256_cvttpd_epi32(a.v));
  }
  /// Where a < b does not hold, numbers or not.
  static LaneMask not_less(Lanes a, Lanes b) {
    return {_mm256_cmp_pd(a.v, b.v, _CMP_NLT_UQ)};
  }
  static LaneMask differ(Lanes a, Lanes b) {
    return {_mm256_cmp_pd(a.v, b.v, _CMP_NEQ_UQ)};
  }
  static std::uint32_t bits_of(LaneMask mask) {
    return static_cast<std::uint32_t>(_mm256_movemask_pd(mask.v));
  }
  /// Rounded towards zero.
  static Words8 to_integers(const Doubles8& v) {
    return {_mm256_set_m128i(_mm256_cvttpd_epi32(v.part[1].v),
                             _mm256_cvttpd_epi32(v.part[0].v))};
  }
  static __m256 to_floats(const Doubles8& v) {
    return _mm256_set_m128(_mm256_cvtpd_ps(v.part[1].v),
                           _mm256_cvtpd_ps(v.part[0].v));
  }
  static FloatMask differ(Floats8 a, Floats8 b) {
    return {_mm256_cmp_ps(a.v, b.v, _CMP_NEQ_UQ)};
  }
  /// a without b.
  static FloatMask and_not(FloatMask a, FloatMask b) {
    return {_mm256_andnot_ps(b.v, a.v)};
  }
  static std::uint32_t bits_of(FloatMask mask) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(mask.v));
  }
  /// All bits of the 8 words whose bit is set in `eight`.
  static __m256i wide_mask(std::uint32_t eight) {
    const __m256i places = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i all = _mm256_set1_epi32(static_cast<int>(eight));
    return _mm256_cmpeq_epi32(_mm256_and_si256(all, places), places);
  }
  /// Those whose bits are set.
  static FloatMask mask_of(std::uint32_t bits) {
    return {_mm256_castsi256_ps(wide_mask(bits))};
  }
  /// b where the mask is set, else a.
  static Floats8 select(Floats8 a, Floats8 b, FloatMask mask) {
    return {_mm256_blendv_ps(a.v, b.v, mask.v)};
  }

  static Words8 load(const std::uint32_t* p) {
    return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
  }
  static void store(std::uint32_t* p, Words8 v) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v.bits);
  }
  /// a without b.
  static Words8 and_not(Words8 a, Words8 b) {
    return {_mm256_andnot_si256(b.bits, a.bits)};
  }
  static bool any(Words8 a) { return _mm256_testz_si256(a.bits, a.bits) == 0; }
  static Words8 none() { return {_mm256_setzero_si256()}; }
  static Words8 every() { return {_mm256_set1_epi32(-1)}; }
  static Words8 all_words(std::uint32_t word) {
    return {_mm256_set1_epi32(static_cast<int>(word))};
  }
  /// All bits of the lines from `first` up to `end`.
  static Words8 lines_between(std::int32_t first, std::int32_t end) {
    const __m256i lines = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    return {
        _mm256_andnot_si256(_mm256_cmpgt_epi32(_mm256_set1_epi32(first), lines),
                            _mm256_cmpgt_epi32(_mm256_set1_epi32(end), lines))};
  }
  /// A bit for each word that is not zero.
  static std::uint32_t some_of(Words8 a) {
    const __m256i empty = _mm256_cmpeq_epi32(a.bits, _mm256_setzero_si256());
    return ~static_cast<std::uint32_t>(
               _mm256_movemask_ps(_mm256_castsi256_ps(empty))) &
           255u;
  }
  static bool all(Words8 a) {
    return _mm256_testc_si256(a.bits, _mm256_set1_epi32(-1)) != 0;
  }

  /// The columns from the least `first` up to the greatest `end` of lines that
  /// are not empty; if all are, an empty range.
  static PixelRange columns_between(Words8 first, Words8 end) {
    const __m256i some = _mm256_cmpgt_epi32(end.bits, first.bits);
    const __m256i left =
        _mm256_blendv_epi8(_mm256_set1_epi32(0x7fffffff), first.bits, some);
    const __m256i right = _mm256_and_si256(end.bits, some);
    __m128i low = _mm_min_epi32(_mm256_castsi256_si128(left),
                                _mm256_extracti128_si256(left, 1));
    __m128i high = _mm_max_epi32(_mm256_castsi256_si128(right),
                                 _mm256_extracti128_si256(right, 1));
    low = _mm_min_epi32(low, _mm_shuffle_epi32(low, 0x4e));
    high = _mm_max_epi32(high, _mm_shuffle_epi32(high, 0x4e));
    low = _mm_min_epi32(low, _mm_shuffle_epi32(low, 0xb1));
    high = _mm_max_epi32(high, _mm_shuffle_epi32(high, 0xb1));
    return {_mm_cvtsi128_si32(low), _mm_cvtsi128_si32(high)};
  }

  /// The columns that all lines have.
  static PixelRange columns_in_all(Words8 first, Words8 end) {
    __m128i low = _mm_max_epi32(_mm256_castsi256_si128(first.bits),
                                _mm256_extracti128_si256(first.bits, 1));
    __m128i high = _mm_min_epi32(_mm256_castsi256_si128(end.bits),
                                 _mm256_extracti128_si256(end.bits, 1));
    low = _mm_max_epi32(low, _mm_shuffle_epi32(low, 0x4e));
    high = _mm_min_epi32(high, _mm_shuffle_epi32(high, 0x4e));
    low = _mm_max_epi32(low, _mm_shuffle_epi32(low, 0xb1));
    high = _mm_min_epi32(high, _mm_shuffle_epi32(high, 0xb1));
    return {_mm_cvtsi128_si32(low), _mm_cvtsi128_si32(high)};
  }

  /// The pixels from `first` up to `end` of each line, of the 32 from `x` on.
  static Words8 cover_of(Words8 first, Words8 end, std::int32_t x) {
    const __m256i start = _mm256_set1_epi32(x);
    const __m256i zero = _mm256_setzero_si256();
    const __m256i ones = _mm256_set1_epi32(-1);
    // A shift by 32 or more gives zero.
    const __m256i from = _mm256_sllv_epi32(
        ones, _mm256_max_epi32(_mm256_sub_epi32(first.bits, start), zero));
    const __m256i beyond = _mm256_sllv_epi32(
        ones, _mm256_max_epi32(_mm256_sub_epi32(end.bits, start), zero));
    return {_mm256_andnot_si256(beyond, from)};
  }

  /// The centres of eight lines from `top` on.
  static Floats8 line_centres(float top) {
    return {_mm256_add_ps(
        _mm256_set1_ps(top),
        _mm256_setr_ps(0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f))};
  }
  static Floats8 floats8(float v) { return {_mm256_set1_ps(v)}; }
  static Floats8 floats8(const Doubles8& v) { return {to_floats(v)}; }
  static Floats8 greater(Floats8 a, Floats8 b) {
    return {_mm256_max_ps(a.v, b.v)};
  }
  static Floats8 smaller(Floats8 a, Floats8 b) {
    return {_mm256_min_ps(a.v, b.v)};
  }
  static Floats8 size_of(Floats8 a) {
    return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)};
  }
  static Floats8 ceiling(Floats8 a) { return {_mm256_ceil_ps(a.v)}; }
  static Floats8 first_centre(Floats8 a) { return ceiling(a - floats8(0.5f)); }
  static void store(float* p, Floats8 v) { _mm256_store_ps(p, v.v); }
  static Words8 to_words(Floats8 v) { return {_mm256_cvttps_epi32(v.v)}; }
};

using Registers = WithEightDoubles<LaneRegisters>;

}  // namespace
}  // namespace halfspace::fast
