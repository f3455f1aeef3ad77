#pragma once

#include <wasm_simd128.h>

#include <cstdint>

#include "camera/edge_function.hpp"
#include "raster/kernel/generic/eight_doubles.hpp"

namespace halfspace::fast {
namespace {

struct Lanes {
  static constexpr int kCount = 2;
  v128_t v;
};
/// Where something holds: all bits of a lane, or none.
struct LaneMask {
  v128_t v;
};
inline Lanes operator+(Lanes a, Lanes b) { return {wasm_f64x2_add(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {wasm_f64x2_sub(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {wasm_f64x2_mul(a.v, b.v)}; }
inline Lanes operator/(Lanes a, Lanes b) { return {wasm_f64x2_div(a.v, b.v)}; }
inline LaneMask operator<(Lanes a, Lanes b) {
  return {wasm_f64x2_lt(a.v, b.v)};
}
inline LaneMask operator&(LaneMask a, LaneMask b) {
  return {wasm_v128_and(a.v, b.v)};
}
inline LaneMask operator|(LaneMask a, LaneMask b) {
  return {wasm_v128_or(a.v, b.v)};
}

using Doubles8 = EightDoubles<Lanes>;

/// Eight numbers of 32 bits, as two registers: for each of 8 lines, or of 8
/// polygons.
struct Halves {
  v128_t low;
  v128_t high;
};
struct Floats8 : Halves {};
/// Where something holds of them.
struct FloatMask : Halves {};
/// One word for each of 8 lines.
struct Words8 : Halves {};

/// An operation on both halves.
template <class Result, class Operation>
inline Result by_halves(const Halves& a, const Halves& b, Operation of) {
  return {{of(a.low, b.low), of(a.high, b.high)}};
}

inline Words8 operator&(const Words8& a, const Words8& b) {
  return by_halves<Words8>(
      a, b, [](v128_t x, v128_t y) { return wasm_v128_and(x, y); });
}
inline Words8 operator|(const Words8& a, const Words8& b) {
  return by_halves<Words8>(
      a, b, [](v128_t x, v128_t y) { return wasm_v128_or(x, y); });
}
inline FloatMask operator<(const Floats8& a, const Floats8& b) {
  return by_halves<FloatMask>(
      a, b, [](v128_t x, v128_t y) { return wasm_f32x4_lt(x, y); });
}
inline FloatMask operator&(const FloatMask& a, const FloatMask& b) {
  return by_halves<FloatMask>(
      a, b, [](v128_t x, v128_t y) { return wasm_v128_and(x, y); });
}
inline FloatMask operator|(const FloatMask& a, const FloatMask& b) {
  return by_halves<FloatMask>(
      a, b, [](v128_t x, v128_t y) { return wasm_v128_or(x, y); });
}
inline FloatMask operator^(const FloatMask& a, const FloatMask& b) {
  return by_halves<FloatMask>(
      a, b, [](v128_t x, v128_t y) { return wasm_v128_xor(x, y); });
}
inline Floats8 operator+(const Floats8& a, const Floats8& b) {
  return by_halves<Floats8>(
      a, b, [](v128_t x, v128_t y) { return wasm_f32x4_add(x, y); });
}
inline Floats8 operator-(const Floats8& a, const Floats8& b) {
  return by_halves<Floats8>(
      a, b, [](v128_t x, v128_t y) { return wasm_f32x4_sub(x, y); });
}
inline Floats8 operator*(const Floats8& a, const Floats8& b) {
  return by_halves<Floats8>(
      a, b, [](v128_t x, v128_t y) { return wasm_f32x4_mul(x, y); });
}
inline Floats8 operator/(const Floats8& a, const Floats8& b) {
  return by_halves<Floats8>(
      a, b, [](v128_t x, v128_t y) { return wasm_f32x4_div(x, y); });
}

/// Registers of 128 bits of WebAssembly: the same lanes with the same results
/// as x86/registers.hpp. The greater of a and b is b where they do not compare,
/// as of maxpd; pmax() has its operands the other way round.
struct LaneRegisters {
  using Lanes = fast::Lanes;
  using LaneMask = fast::LaneMask;
  using Doubles8 = fast::Doubles8;
  using Floats8 = fast::Floats8;
  using FloatMask = fast::FloatMask;
  using Words8 = fast::Words8;

  static Lanes lanes(double v) { return {wasm_f64x2_splat(v)}; }
  static Lanes count_from(double v) {
    return {wasm_f64x2_add(wasm_f64x2_splat(v), wasm_f64x2_const(0, 1))};
  }
  static Lanes widened(const float* p) {
    return {wasm_f64x2_promote_low_f32x4(wasm_v128_load64_zero(p))};
  }
  static Lanes widened(const std::int32_t* p) {
    return {wasm_f64x2_convert_low_i32x4(wasm_v128_load64_zero(p))};
  }
  static Lanes greater(Lanes a, Lanes b) { return {wasm_f64x2_pmax(b.v, a.v)}; }
  static Lanes smaller(Lanes a, Lanes b) { return {wasm_f64x2_pmin(b.v, a.v)}; }
  static Lanes size_of(Lanes a) { return {wasm_f64x2_abs(a.v)}; }
  static Lanes ceiling(Lanes a) { return {wasm_f64x2_ceil(a.v)}; }
  static Lanes first_centre(Lanes a) { return ceiling(a - lanes(0.5)); }
  /// Rounded towards zero.
  static void store(std::int32_t* p, Lanes a) {
    wasm_v128_store64_lane(p, wasm_i32x4_trunc_sat_f64x2_zero(a.v), 0);
  }
  /// Where a < b does not hold, numbers or not.
  static LaneMask not_less(Lanes a, Lanes b) {
    return {wasm_v128_not(wasm_f64x2_lt(a.v, b.v))};
  }
  static LaneMask differ(Lanes a, Lanes b) { return {wasm_f64x2_ne(a.v, b.v)}; }
  static std::uint32_t bits_of(LaneMask mask) {
    return wasm_i64x2_bitmask(mask.v);
  }
  /// Rounded towards zero.
  static Words8 to_integers(const Doubles8& v) {
    const auto both = [](Lanes a, Lanes b) {
      const v128_t x = wasm_i32x4_trunc_sat_f64x2_zero(a.v);
      const v128_t y = wasm_i32x4_trunc_sat_f64x2_zero(b.v);
      return wasm_i32x4_shuffle(x, y, 0, 1, 4, 5);
    };
    return {{both(v.part[0], v.part[1]), both(v.part[2], v.part[3])}};
  }
  static Floats8 floats8(const Doubles8& v) {
    const auto both = [](Lanes a, Lanes b) {
      const v128_t x = wasm_f32x4_demote_f64x2_zero(a.v);
      const v128_t y = wasm_f32x4_demote_f64x2_zero(b.v);
      return wasm_i32x4_shuffle(x, y, 0, 1, 4, 5);
    };
    return {{both(v.part[0], v.part[1]), both(v.part[2], v.part[3])}};
  }
  static Floats8 floats8(float v) {
    return {{wasm_f32x4_splat(v), wasm_f32x4_splat(v)}};
  }
  static FloatMask differ(const Floats8& a, const Floats8& b) {
    return by_halves<FloatMask>(
        a, b, [](v128_t x, v128_t y) { return wasm_f32x4_ne(x, y); });
  }
  /// a without b.
  static FloatMask and_not(const FloatMask& a, const FloatMask& b) {
    return by_halves<FloatMask>(
        a, b, [](v128_t x, v128_t y) { return wasm_v128_andnot(x, y); });
  }
  static std::uint32_t bits_of(const FloatMask& mask) {
    return wasm_i32x4_bitmask(mask.low) | wasm_i32x4_bitmask(mask.high) << 4;
  }
  /// Those whose bits are set.
  static FloatMask mask_of(std::uint32_t bits) {
    const auto half = [bits](v128_t places) {
      const v128_t all = wasm_i32x4_splat(static_cast<std::int32_t>(bits));
      return wasm_i32x4_eq(wasm_v128_and(all, places), places);
    };
    return {{half(wasm_i32x4_const(1, 2, 4, 8)),
             half(wasm_i32x4_const(16, 32, 64, 128))}};
  }
  /// b where the mask is set, else a.
  static Floats8 select(const Floats8& a, const Floats8& b,
                        const FloatMask& mask) {
    return {{wasm_v128_bitselect(b.low, a.low, mask.low),
             wasm_v128_bitselect(b.high, a.high, mask.high)}};
  }

  static Words8 load(const std::uint32_t* p) {
    return {{wasm_v128_load(p), wasm_v128_load(p + 4)}};
  }
  static void store(std::uint32_t* p, const Words8& v) {
    wasm_v128_store(p, v.low);
    wasm_v128_store(p + 4, v.high);
  }
  /// a without b.
  static Words8 and_not(const Words8& a, const Words8& b) {
    return by_halves<Words8>(
        a, b, [](v128_t x, v128_t y) { return wasm_v128_andnot(x, y); });
  }
  static bool any(const Words8& a) {
    return wasm_v128_any_true(wasm_v128_or(a.low, a.high));
  }
  static Words8 none() { return all_words(0); }
  static Words8 every() { return all_words(~std::uint32_t{0}); }
  static Words8 all_words(std::uint32_t word) {
    const v128_t half = wasm_u32x4_splat(word);
    return {{half, half}};
  }
  /// All bits of the lines from `first` up to `end`.
  static Words8 lines_between(std::int32_t first, std::int32_t end) {
    const auto half = [first, end](v128_t lines) {
      return wasm_v128_and(wasm_i32x4_ge(lines, wasm_i32x4_splat(first)),
                           wasm_i32x4_lt(lines, wasm_i32x4_splat(end)));
    };
    return {{half(wasm_i32x4_const(0, 1, 2, 3)),
             half(wasm_i32x4_const(4, 5, 6, 7))}};
  }
  /// A bit for each word that is not zero.
  static std::uint32_t some_of(const Words8& a) {
    const auto half = [](v128_t v) {
      return wasm_i32x4_bitmask(wasm_i32x4_ne(v, wasm_i32x4_const_splat(0)));
    };
    return half(a.low) | half(a.high) << 4;
  }
  static bool all(const Words8& a) {
    const v128_t both = wasm_v128_and(a.low, a.high);
    return !wasm_v128_any_true(wasm_v128_not(both));
  }

  /// The least, or the greatest, of four words.
  static std::int32_t least_of(v128_t v) {
    v = wasm_i32x4_min(v, wasm_i32x4_shuffle(v, v, 2, 3, 0, 1));
    v = wasm_i32x4_min(v, wasm_i32x4_shuffle(v, v, 1, 0, 3, 2));
    return wasm_i32x4_extract_lane(v, 0);
  }
  static std::int32_t greatest_of(v128_t v) {
    v = wasm_i32x4_max(v, wasm_i32x4_shuffle(v, v, 2, 3, 0, 1));
    v = wasm_i32x4_max(v, wasm_i32x4_shuffle(v, v, 1, 0, 3, 2));
    return wasm_i32x4_extract_lane(v, 0);
  }

  /// The columns from the least `first` up to the greatest `end` of lines that
  /// are not empty; if all are, an empty range.
  static PixelRange columns_between(const Words8& first, const Words8& end) {
    const v128_t far = wasm_i32x4_const_splat(0x7fffffff);
    const auto left = [far](v128_t from, v128_t to) {
      return wasm_v128_bitselect(from, far, wasm_i32x4_gt(to, from));
    };
    const auto right = [](v128_t from, v128_t to) {
      return wasm_v128_and(to, wasm_i32x4_gt(to, from));
    };
    return {least_of(wasm_i32x4_min(left(first.low, end.low),
                                    left(first.high, end.high))),
            greatest_of(wasm_i32x4_max(right(first.low, end.low),
                                       right(first.high, end.high)))};
  }

  /// The columns that all lines have.
  static PixelRange columns_in_all(const Words8& first, const Words8& end) {
    return {greatest_of(wasm_i32x4_max(first.low, first.high)),
            least_of(wasm_i32x4_min(end.low, end.high))};
  }

  /// The pixels from `first` up to `end` of each line, of the 32 from `x` on.
  ///
  /// There is no shift of lanes by different counts, so it goes word by word.
  static Words8 cover_of(const Words8& first, const Words8& end,
                         std::int32_t x) {
    alignas(16) std::int32_t from[8];
    alignas(16) std::int32_t to[8];
    alignas(16) std::uint32_t cover[8];
    const v128_t start = wasm_i32x4_splat(x);
    const v128_t zero = wasm_i32x4_const_splat(0);
    const v128_t width = wasm_i32x4_const_splat(32);
    const auto within = [&](v128_t v) {
      return wasm_i32x4_min(wasm_i32x4_max(wasm_i32x4_sub(v, start), zero),
                            width);
    };
    wasm_v128_store(from, within(first.low));
    wasm_v128_store(from + 4, within(first.high));
    wasm_v128_store(to, within(end.low));
    wasm_v128_store(to + 4, within(end.high));
    for (int r = 0; r < 8; ++r) {
      // Of 64 bits, so that a shift by 32 gives zero in the lower half.
      const std::uint64_t beyond = ~std::uint64_t{0} << to[r];
      cover[r] =
          static_cast<std::uint32_t>((~std::uint64_t{0} << from[r]) & ~beyond);
    }
    return load(cover);
  }

  /// The centres of eight lines from `top` on.
  static Floats8 line_centres(float top) {
    const v128_t start = wasm_f32x4_splat(top);
    return {{wasm_f32x4_add(start, wasm_f32x4_const(0.5f, 1.5f, 2.5f, 3.5f)),
             wasm_f32x4_add(start, wasm_f32x4_const(4.5f, 5.5f, 6.5f, 7.5f))}};
  }
  static Floats8 greater(const Floats8& a, const Floats8& b) {
    return by_halves<Floats8>(
        a, b, [](v128_t x, v128_t y) { return wasm_f32x4_pmax(y, x); });
  }
  static Floats8 smaller(const Floats8& a, const Floats8& b) {
    return by_halves<Floats8>(
        a, b, [](v128_t x, v128_t y) { return wasm_f32x4_pmin(y, x); });
  }
  static Floats8 size_of(const Floats8& a) {
    return {{wasm_f32x4_abs(a.low), wasm_f32x4_abs(a.high)}};
  }
  static Floats8 ceiling(const Floats8& a) {
    return {{wasm_f32x4_ceil(a.low), wasm_f32x4_ceil(a.high)}};
  }
  static Floats8 first_centre(const Floats8& a) {
    return ceiling(a - floats8(0.5f));
  }
  static void store(float* p, const Floats8& v) {
    wasm_v128_store(p, v.low);
    wasm_v128_store(p + 4, v.high);
  }
  static Words8 to_words(const Floats8& v) {
    return {{wasm_i32x4_trunc_sat_f32x4(v.low),
             wasm_i32x4_trunc_sat_f32x4(v.high)}};
  }
};

using Registers = WithEightDoubles<LaneRegisters>;

}  // namespace
}  // namespace halfspace::fast
