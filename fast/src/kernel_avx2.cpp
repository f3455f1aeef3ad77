#include "kernel.hpp"

#if defined(__x86_64__)
#include <immintrin.h>

namespace halfspace::fast {
namespace {

/// An outline has at most this many corners; others go line by line.
constexpr std::int32_t kMostBounds = 32;

/// One number for each of 8 lines.
struct Doubles8 {
  __m256d low;
  __m256d high;
};
/// One word for each of 8 lines.
struct Words8 {
  __m256i bits;
};

inline Doubles8 all_lines(double v) {
  return {_mm256_set1_pd(v), _mm256_set1_pd(v)};
}
inline Doubles8 lines_from(double top) {
  const __m256d start = _mm256_set1_pd(top);
  return {_mm256_add_pd(start, _mm256_setr_pd(0, 1, 2, 3)),
          _mm256_add_pd(start, _mm256_setr_pd(4, 5, 6, 7))};
}
inline Doubles8 operator+(Doubles8 a, Doubles8 b) {
  return {_mm256_add_pd(a.low, b.low), _mm256_add_pd(a.high, b.high)};
}
inline Doubles8 operator-(Doubles8 a, Doubles8 b) {
  return {_mm256_sub_pd(a.low, b.low), _mm256_sub_pd(a.high, b.high)};
}
inline Doubles8 operator*(Doubles8 a, Doubles8 b) {
  return {_mm256_mul_pd(a.low, b.low), _mm256_mul_pd(a.high, b.high)};
}
inline Doubles8 greater(Doubles8 a, Doubles8 b) {
  return {_mm256_max_pd(a.low, b.low), _mm256_max_pd(a.high, b.high)};
}
inline Doubles8 smaller(Doubles8 a, Doubles8 b) {
  return {_mm256_min_pd(a.low, b.low), _mm256_min_pd(a.high, b.high)};
}

/// The first pixels whose centres are not left of the x, within the columns.
inline __m256i to_columns(Doubles8 x, double from, double to) {
  const __m256d half = _mm256_set1_pd(0.5);
  const __m256d low = _mm256_set1_pd(from);
  const __m256d high = _mm256_set1_pd(to);
  const auto column = [&](__m256d v) {
    const __m256d up = _mm256_ceil_pd(_mm256_sub_pd(v, half));
    return _mm256_cvttpd_epi32(_mm256_min_pd(_mm256_max_pd(up, low), high));
  };
  return _mm256_set_m128i(column(x.high), column(x.low));
}

inline std::uint32_t columns_of(Doubles8 left_low, Doubles8 left_high,
                                Doubles8 right_low, Doubles8 right_high,
                                std::int32_t from, std::int32_t to,
                                std::int32_t* first, std::int32_t* end) {
  const __m256i first_low = to_columns(left_low, from, to);
  const __m256i first_high = to_columns(left_high, from, to);
  const __m256i end_low = to_columns(right_low, from, to);
  const __m256i end_high = to_columns(right_high, from, to);
  _mm256_store_si256(reinterpret_cast<__m256i*>(first), first_low);
  _mm256_store_si256(reinterpret_cast<__m256i*>(end), end_high);
  const __m256i told =
      _mm256_and_si256(_mm256_cmpeq_epi32(first_low, first_high),
                       _mm256_cmpeq_epi32(end_low, end_high));
  // Where even the widest reading is empty there is nothing to tell.
  const __m256i some = _mm256_cmpgt_epi32(end_high, first_low);
  return static_cast<std::uint32_t>(
      _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_andnot_si256(told, some))));
}

inline Words8 load(const std::uint32_t* p) {
  return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
}
inline Words8 load_columns(const std::int32_t* p) {
  return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
}
inline void store(std::uint32_t* p, Words8 v) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v.bits);
}
inline Words8 operator&(Words8 a, Words8 b) {
  return {_mm256_and_si256(a.bits, b.bits)};
}
inline Words8 operator|(Words8 a, Words8 b) {
  return {_mm256_or_si256(a.bits, b.bits)};
}
/// a without b.
inline Words8 and_not(Words8 a, Words8 b) {
  return {_mm256_andnot_si256(b.bits, a.bits)};
}
inline bool any(Words8 a) { return _mm256_testz_si256(a.bits, a.bits) == 0; }
inline bool all(Words8 a) {
  return _mm256_testc_si256(a.bits, _mm256_set1_epi32(-1)) != 0;
}

/// The pixels from `first` up to `end` of each line, of the 32 from `x` on.
inline Words8 cover_of(Words8 first, Words8 end, std::int32_t x) {
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

inline void store_items(std::int32_t* line, std::uint32_t bits,
                        std::int32_t id) {
  const __m256i ids = _mm256_set1_epi32(id);
  if (bits == ~std::uint32_t{0}) {
    for (int k = 0; k < 4; ++k) {
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(line + 8 * k), ids);
    }
    return;
  }
  const __m256i places = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  for (int k = 0; k < 4; ++k, bits >>= 8) {
    if ((bits & 255u) == 0) continue;
    const __m256i eight = _mm256_set1_epi32(static_cast<int>(bits & 255u));
    const __m256i chosen =
        _mm256_cmpeq_epi32(_mm256_and_si256(eight, places), places);
    _mm256_maskstore_epi32(line + 8 * k, chosen, ids);
  }
}

inline void store_colors(std::uint8_t* out, int count,
                         const std::uint8_t* rgb) {
  const std::uint32_t word =
      rgb[0] | (std::uint32_t{rgb[1]} << 8) | (std::uint32_t{rgb[2]} << 16);
  if (count >= 11) {
    // 32 bytes hold ten pixels and two thirds: stores of ten overlap.
    const __m256i three = _mm256_set1_epi32(static_cast<int>(word));
    const __m256i packed = _mm256_shuffle_epi8(
        three,
        _mm256_setr_epi8(0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2,
                         0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1));
    do {
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), packed);
      out += 30;
      count -= 10;
    } while (count >= 11);
  }
  for (; count > 1; --count, out += 3) __builtin_memcpy(out, &word, 4);
  if (count > 0) {
    out[0] = rgb[0];
    out[1] = rgb[1];
    out[2] = rgb[2];
  }
}

#include "kernel.inc"

}  // namespace

const Kernel kAvx2Kernel = {draw, draw_lines, any_open, fill_rest};

}  // namespace halfspace::fast
#endif
