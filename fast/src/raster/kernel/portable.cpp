#include "raster/kernel/generic/scalar_pixels.hpp"
#include "raster/kernel/generic/scalar_sums.hpp"
#include "raster/kernel/generic/tile_rows.hpp"
#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {
namespace {

/// One number for each of 8 lines.
struct Doubles8 {
  double lines[8];
};
/// One word for each of 8 lines.
struct Words8 {
  std::uint32_t lines[8];
};

template <class Of>
inline Doubles8 doubles(Of&& of) {
  Doubles8 result;
  for (int r = 0; r < 8; ++r) result.lines[r] = of(r);
  return result;
}
template <class Of>
inline Words8 words(Of&& of) {
  Words8 result;
  for (int r = 0; r < 8; ++r) result.lines[r] = of(r);
  return result;
}

inline Doubles8 operator+(const Doubles8& a, const Doubles8& b) {
  return doubles([&](int r) { return a.lines[r] + b.lines[r]; });
}
inline Doubles8 operator*(const Doubles8& a, const Doubles8& b) {
  return doubles([&](int r) { return a.lines[r] * b.lines[r]; });
}
inline Words8 operator&(const Words8& a, const Words8& b) {
  return words([&](int r) { return a.lines[r] & b.lines[r]; });
}
inline Words8 operator|(const Words8& a, const Words8& b) {
  return words([&](int r) { return a.lines[r] | b.lines[r]; });
}

/// What the loops of generic/ take from any processor.
struct PortableSimd : ScalarPixels, ScalarSums {
  using Doubles8 = fast::Doubles8;
  using Words8 = fast::Words8;

  /// An outline has at most this many corners; others go line by line.
  static constexpr std::int32_t kMostBounds = 32;

  static Doubles8 all_lines(double v) {
    return doubles([&](int) { return v; });
  }

  static Doubles8 lines_from(double top) {
    return doubles([&](int r) { return top + r; });
  }

  static Doubles8 greater(const Doubles8& a, const Doubles8& b) {
    return doubles([&](int r) {
      return a.lines[r] > b.lines[r] ? a.lines[r] : b.lines[r];
    });
  }

  static Doubles8 smaller(const Doubles8& a, const Doubles8& b) {
    return doubles([&](int r) {
      return a.lines[r] < b.lines[r] ? a.lines[r] : b.lines[r];
    });
  }

  /// The first pixel whose centre is not left of `x`, within the columns.
  static std::int32_t to_column(double x, std::int32_t from, std::int32_t to) {
    const double v = x - 0.5;
    if (!(v > from)) return from;
    if (!(v < to)) return to;
    const auto k = static_cast<std::int32_t>(v);
    return k + (v > k ? 1 : 0);
  }

  /// The pixels of 8 lines from `first` up to `end`, but on lines in doubt.
  struct Spans {
    Words8 first;
    Words8 end;
    std::uint32_t doubt;
  };

  /// The pixels between the left and the right x of 8 lines, which are off by
  /// at most the errors: where that matters there is doubt.
  static Spans columns_of(const Doubles8& left, double left_error,
                          const Doubles8& right, double right_error,
                          std::int32_t from, std::int32_t to) {
    Spans spans{};
    for (int r = 0; r < 8; ++r) {
      const std::int32_t first =
          to_column(left.lines[r] - left_error, from, to);
      const std::int32_t end =
          to_column(right.lines[r] + right_error, from, to);
      const bool known =
          first == to_column(left.lines[r] + left_error, from, to) &&
          end == to_column(right.lines[r] - right_error, from, to);
      // Where even the widest reading is empty there is nothing to decide.
      if (!known && end > first) spans.doubt |= 1u << r;
      spans.first.lines[r] = static_cast<std::uint32_t>(first);
      spans.end.lines[r] = static_cast<std::uint32_t>(end);
    }
    return spans;
  }

  static Words8 load(const std::uint32_t* p) {
    return words([&](int r) { return p[r]; });
  }

  static void store(std::uint32_t* p, const Words8& v) {
    for (int r = 0; r < 8; ++r) p[r] = v.lines[r];
  }

  /// a without b.
  static Words8 and_not(const Words8& a, const Words8& b) {
    return words([&](int r) { return a.lines[r] & ~b.lines[r]; });
  }

  static bool any(const Words8& a) {
    std::uint32_t some = 0;
    for (int r = 0; r < 8; ++r) some |= a.lines[r];
    return some != 0;
  }

  static Words8 none() {
    return words([](int) { return std::uint32_t{0}; });
  }

  static Words8 every() {
    return words([](int) { return ~std::uint32_t{0}; });
  }

  static Words8 all_words(std::uint32_t word) {
    return words([word](int) { return word; });
  }

  /// All bits of the lines from `first` up to `end`.
  static Words8 lines_between(std::int32_t first, std::int32_t end) {
    return words(
        [=](int r) { return r >= first && r < end ? ~std::uint32_t{0} : 0u; });
  }

  /// A bit for each word that is not zero.
  static std::uint32_t some_of(const Words8& a) {
    std::uint32_t some = 0;
    for (int r = 0; r < 8; ++r) some |= (a.lines[r] != 0 ? 1u : 0u) << r;
    return some;
  }

  static bool all(const Words8& a) {
    std::uint32_t every = ~std::uint32_t{0};
    for (int r = 0; r < 8; ++r) every &= a.lines[r];
    return every == ~std::uint32_t{0};
  }

  /// The columns from the least `first` up to the greatest `end` of lines that
  /// are not empty; if all are, an empty range.
  static PixelRange columns_between(const Words8& first, const Words8& end) {
    PixelRange range = {0x7fffffff, 0};
    for (int r = 0; r < 8; ++r) {
      const auto from = static_cast<std::int32_t>(first.lines[r]);
      const auto to = static_cast<std::int32_t>(end.lines[r]);
      if (from >= to) continue;
      range.first = from < range.first ? from : range.first;
      range.end = to > range.end ? to : range.end;
    }
    return range;
  }

  /// The columns that all lines have.
  static PixelRange columns_in_all(const Words8& first, const Words8& end) {
    PixelRange range = {0, 0x7fffffff};
    for (int r = 0; r < 8; ++r) {
      const auto from = static_cast<std::int32_t>(first.lines[r]);
      const auto to = static_cast<std::int32_t>(end.lines[r]);
      range.first = from > range.first ? from : range.first;
      range.end = to < range.end ? to : range.end;
    }
    return range;
  }

  /// The pixels from `first` up to `end` of each line, of the 32 from `x` on.
  static Words8 cover_of(const Words8& first, const Words8& end,
                         std::int32_t x) {
    const auto from = [x](std::uint32_t column) -> std::uint32_t {
      const std::int32_t shift = static_cast<std::int32_t>(column) - x;
      if (shift >= 32) return 0;
      return ~std::uint32_t{0} << (shift > 0 ? shift : 0);
    };
    return words(
        [&](int r) { return from(first.lines[r]) & ~from(end.lines[r]); });
  }
};

/// Without boxes and blocks, which others decide and draw one by one.
struct PortableKernel : TileRows<PortableSimd> {
  static BoxVisibility box_visibility(const TileView&, const BoxView&,
                                      const Box&) {
    return BoxVisibility::kUnknown;
  }
  template <std::size_t kCorners>
  static BlockDrawn draw_block(TileView&, const View&, bool,
                               const FragmentBlock<kCorners>& block) {
    return {0, (1u << block.count) - 1};
  }
};

}  // namespace

const TileKernel kPortableKernel = table_of<PortableKernel>();

bool is_supported(SimdLevel level) {
#if defined(__x86_64__)
  const bool avx2 = __builtin_cpu_supports("avx2") != 0 &&
                    __builtin_cpu_supports("bmi") != 0 &&
                    __builtin_cpu_supports("popcnt") != 0;
  const bool avx512 = __builtin_cpu_supports("avx512f") != 0 &&
                      __builtin_cpu_supports("avx512bw") != 0 &&
                      __builtin_cpu_supports("avx512dq") != 0 &&
                      __builtin_cpu_supports("avx512vl") != 0 &&
                      __builtin_cpu_supports("avx512vbmi") != 0 &&
                      __builtin_cpu_supports("bmi2") != 0;
#else
  const bool avx2 = false;
  const bool avx512 = false;
#endif
  switch (level) {
    case SimdLevel::kAvx2:
      return avx2;
    case SimdLevel::kAvx512:
      return avx2 && avx512;
    case SimdLevel::kPortable:
    case SimdLevel::kBest:
      break;
  }
  return true;
}

const TileKernel& best_kernel(SimdLevel level) {
#if defined(__x86_64__)
  if (level >= SimdLevel::kAvx512 && is_supported(SimdLevel::kAvx512)) {
    return kAvx512Kernel;
  }
  if (level >= SimdLevel::kAvx2 && is_supported(SimdLevel::kAvx2)) {
    return kAvx2Kernel;
  }
#elif defined(__wasm_simd128__)
  if (level > SimdLevel::kPortable) return kWasm128Kernel;
#else
  (void)level;
#endif
  return kPortableKernel;
}

}  // namespace halfspace::fast
