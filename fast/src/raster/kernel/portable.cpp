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
struct PortableSimd {
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

  /// Stores `id` at first + k for every bit k.
  static void store_items(std::int32_t* items, std::int64_t first,
                          std::uint32_t bits, std::int32_t id, bool) {
    for (; bits != 0; bits &= bits - 1) items[first + __builtin_ctz(bits)] = id;
  }

  /// Stores `id` in a line of `tiles` tiles.
  static void fill_items(std::int32_t* to, std::int32_t tiles,
                         std::int32_t id) {
    for (std::int32_t k = 0; k < 32 * tiles; ++k) to[k] = id;
  }

  /// Copies 32 items, or the colours of 32 pixels.
  static void copy_items(std::int32_t* to, const std::int32_t* from) {
    for (int k = 0; k < 32; ++k) to[k] = from[k];
  }

  static void copy_colors(std::uint8_t* to, const std::uint8_t* from) {
    for (int k = 0; k < 96; ++k) to[k] = from[k];
  }

  /// Copies those that have their bits set.
  static void copy_some_items(std::int32_t* to, const std::int32_t* from,
                              std::uint32_t bits, bool) {
    for (; bits != 0; bits &= bits - 1) {
      to[__builtin_ctz(bits)] = from[__builtin_ctz(bits)];
    }
  }

  static void copy_some_colors(std::uint8_t* to, const std::uint8_t* from,
                               std::uint32_t bits, bool) {
    for (; bits != 0; bits &= bits - 1) {
      const int k = 3 * __builtin_ctz(bits);
      for (int c = k; c < k + 3; ++c) to[c] = from[c];
    }
  }

  struct FlatColor {
    std::uint8_t rgb[3];
  };

  static FlatColor flat_color(std::uint32_t packed) {
    return {{static_cast<std::uint8_t>(packed),
             static_cast<std::uint8_t>(packed >> 8),
             static_cast<std::uint8_t>(packed >> 16)}};
  }

  /// Fills `tiles` times 32 pixels, one after another.
  static void fill_colors(std::uint8_t* colors, std::int32_t tiles,
                          const FlatColor& color) {
    for (std::int32_t k = 0; k < 3 * 32 * tiles; ++k) {
      colors[k] = color.rgb[k % 3];
    }
  }

  /// Stores the colour at pixel k after byte `first` for every bit k.
  static void store_colors(std::uint8_t* colors, std::int64_t first,
                           std::uint32_t bits, const FlatColor& color, bool) {
    for (; bits != 0; bits &= bits - 1) {
      std::uint8_t* at = colors + first + 3 * __builtin_ctz(bits);
      at[0] = color.rgb[0];
      at[1] = color.rgb[1];
      at[2] = color.rgb[2];
    }
  }

  /// Here all tiles are put together part by part.
  static bool write_flat(const TileView&, const MaskList&, bool, std::int32_t,
                         std::int32_t, const Words8&, const PixelSource*) {
    return false;
  }

  /// Here each line is for itself.
  static bool shade_blocks(const Target&, const Gradient&, std::int32_t,
                           std::int32_t, const std::uint32_t*, std::uint32_t*) {
    return false;
  }

  struct ShadedTile {};

  static bool start_tile(const Gradient&, std::int32_t, std::int32_t,
                         std::uint32_t, const std::uint32_t*, ShadedTile&) {
    return false;
  }

  static void shade_lines(const Target&, const ShadedTile&, std::uint32_t,
                          const std::uint32_t*, std::uint32_t*) {}

  /// Colours the pixels `bits` of line r of a tile; gives those in doubt.
  static std::uint32_t shade_pixels(const Target& target,
                                    const ShadedLine& line, std::int32_t r,
                                    std::uint32_t bits) {
    std::uint32_t left = 0;
    std::uint8_t* to = target.colors + target.at + r * target.stride;
    for (; bits != 0; bits &= bits - 1) {
      const int pixel = __builtin_ctz(bits);
      const auto steps = static_cast<float>(pixel - line.first);
      const float reciprocal = 1 / (line.d0 + line.d * steps);
      for (int c = 0; c < 3; ++c) {
        const float value = (line.n0[c] + line.n1[c] * steps) * reciprocal;
        // Pixels that are not covered are not asked for: this fits.
        const auto level = static_cast<std::int32_t>(value);
        if (((level + line.doubt) & 0xffff) < 2 * line.doubt) {
          left |= 1u << pixel;
        }
        to[3 * pixel + c] = static_cast<std::uint8_t>(level >> 16);
      }
    }
    return left;
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
#else
  (void)level;
#endif
  return kPortableKernel;
}

}  // namespace halfspace::fast
