#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "raster/kernel/generic/scalar.hpp"
#include "raster/kernel/x86/registers.hpp"

namespace halfspace::fast {
namespace {

/// How items and colours are stored.
struct ColorStore : Registers {
  using Registers::store;

  /// Stores `id` at first + k for every bit k. `whole`: all 32 places are
  /// there.
  static void store_items(std::int32_t* items, std::int64_t first,
                          std::uint32_t bits, std::int32_t id, bool whole) {
    if (!whole) {
      for (; bits != 0; bits &= bits - 1) {
        items[first + __builtin_ctz(bits)] = id;
      }
      return;
    }
    const __m256i ids = _mm256_set1_epi32(id);
    auto* at = reinterpret_cast<__m256i*>(items + first);
    if (bits == ~std::uint32_t{0}) {
      for (int k = 0; k < 4; ++k) _mm256_storeu_si256(at + k, ids);
      return;
    }
    // Reading and writing all is faster than storing under a mask.
    for (; bits != 0; ++at, bits >>= 8) {
      if ((bits & 255u) == 0) continue;
      _mm256_storeu_si256(at, _mm256_blendv_epi8(_mm256_loadu_si256(at), ids,
                                                 wide_mask(bits & 255u)));
    }
  }

  /// Copies 32 items, or the colours of 32 pixels.
  static void copy_items(std::int32_t* to, const std::int32_t* from) {
    for (int k = 0; k < 32; k += 8) {
      _mm256_storeu_si256(
          reinterpret_cast<__m256i*>(to + k),
          _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + k)));
    }
  }
  static void copy_colors(std::uint8_t* to, const std::uint8_t* from) {
    for (int k = 0; k < 96; k += 32) {
      _mm256_storeu_si256(
          reinterpret_cast<__m256i*>(to + k),
          _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + k)));
    }
  }

  /// Stores `id` in a line of `tiles` tiles.
  static void fill_items(std::int32_t* to, std::int32_t tiles,
                         std::int32_t id) {
    const __m256i ids = _mm256_set1_epi32(id);
    auto* at = reinterpret_cast<__m256i*>(to);
    for (std::int32_t k = 0; k < 4 * tiles; ++k) _mm256_storeu_si256(at++, ids);
  }

  /// A colour 32 times over.
  struct FlatColor {
    __m256i bytes[3];
    std::uint32_t packed;
  };

  static FlatColor flat_color(std::uint32_t packed) {
    const __m256i all = _mm256_set1_epi32(static_cast<int>(packed));
    const __m256i from_red =
        _mm256_setr_epi8(0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2,
                         0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1);
    const __m256i from_blue =
        _mm256_setr_epi8(2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1,
                         2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0);
    const __m256i from_green =
        _mm256_setr_epi8(1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0,
                         1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2);
    return {{_mm256_shuffle_epi8(all, from_red),
             _mm256_shuffle_epi8(all, from_blue),
             _mm256_shuffle_epi8(all, from_green)},
            packed};
  }

  /// Fills `tiles` times 32 pixels, one after another.
  static void fill_colors(std::uint8_t* colors, std::int32_t tiles,
                          const FlatColor& color) {
    auto* at = reinterpret_cast<__m256i*>(colors);
    for (std::int32_t t = 0; t < tiles; ++t, at += 3) {
      for (int k = 0; k < 3; ++k) _mm256_storeu_si256(at + k, color.bytes[k]);
    }
  }

  /// The bytes of the 32 pixels that have their bits set, 32 bytes from byte
  /// 32 * kThird on: byte b belongs to pixel b / 3.
  template <int kThird>
  static __m256i byte_mask(std::uint32_t bits) {
    constexpr auto byte = [](int b) {
      return static_cast<char>((32 * kThird + b) / 3 / 8);
    };
    constexpr auto place = [](int b) {
      return static_cast<char>(1 << ((32 * kThird + b) / 3 % 8));
    };
    const __m256i bytes = _mm256_setr_epi8(
        byte(0), byte(1), byte(2), byte(3), byte(4), byte(5), byte(6), byte(7),
        byte(8), byte(9), byte(10), byte(11), byte(12), byte(13), byte(14),
        byte(15), byte(16), byte(17), byte(18), byte(19), byte(20), byte(21),
        byte(22), byte(23), byte(24), byte(25), byte(26), byte(27), byte(28),
        byte(29), byte(30), byte(31));
    const __m256i places = _mm256_setr_epi8(
        place(0), place(1), place(2), place(3), place(4), place(5), place(6),
        place(7), place(8), place(9), place(10), place(11), place(12),
        place(13), place(14), place(15), place(16), place(17), place(18),
        place(19), place(20), place(21), place(22), place(23), place(24),
        place(25), place(26), place(27), place(28), place(29), place(30),
        place(31));
    const __m256i all = _mm256_set1_epi32(static_cast<int>(bits));
    return _mm256_cmpeq_epi8(
        _mm256_and_si256(_mm256_shuffle_epi8(all, bytes), places), places);
  }

  /// Copies those of 32 items, or of the colours of 32 pixels, that have their
  /// bits set. `whole`: all 32 places are there.
  static void copy_some_items(std::int32_t* to, const std::int32_t* from,
                              std::uint32_t bits, bool whole) {
    for (; !whole && bits != 0; bits &= bits - 1) {
      to[__builtin_ctz(bits)] = from[__builtin_ctz(bits)];
    }
    for (int k = 0; bits != 0; k += 8, bits >>= 8) {
      auto* at = reinterpret_cast<__m256i*>(to + k);
      const __m256i items =
          _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + k));
      _mm256_storeu_si256(at, _mm256_blendv_epi8(_mm256_loadu_si256(at), items,
                                                 wide_mask(bits & 255u)));
    }
  }
  static void copy_some_colors(std::uint8_t* to, const std::uint8_t* from,
                               std::uint32_t bits, bool whole) {
    for (; !whole && bits != 0; bits &= bits - 1) {
      const int k = 3 * __builtin_ctz(bits);
      to[k] = from[k];
      to[k + 1] = from[k + 1];
      to[k + 2] = from[k + 2];
    }
    const auto blend = [&](int third, __m256i mask) {
      auto* at = reinterpret_cast<__m256i*>(to) + third;
      const __m256i colors =
          _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from) + third);
      _mm256_storeu_si256(
          at, _mm256_blendv_epi8(_mm256_loadu_si256(at), colors, mask));
    };
    if ((bits & 0x000007ffu) != 0) blend(0, byte_mask<0>(bits));
    if ((bits & 0x003ffc00u) != 0) blend(1, byte_mask<1>(bits));
    if ((bits & 0xffe00000u) != 0) blend(2, byte_mask<2>(bits));
  }

  /// Stores the colour at pixel k after byte `first` for every bit k.
  static void store_colors(std::uint8_t* colors, std::int64_t first,
                           std::uint32_t bits, const FlatColor& color,
                           bool whole) {
    if (!whole) {
      for (; bits != 0; bits &= bits - 1) {
        std::uint8_t* at = colors + first + 3 * __builtin_ctz(bits);
        scalar::store_pixel(at, color.packed);
      }
      return;
    }
    auto* at = reinterpret_cast<__m256i*>(colors + first);
    if (bits == ~std::uint32_t{0}) {
      for (int k = 0; k < 3; ++k) _mm256_storeu_si256(at + k, color.bytes[k]);
      return;
    }
    const auto blend = [&](int third, __m256i mask) {
      _mm256_storeu_si256(at + third,
                          _mm256_blendv_epi8(_mm256_loadu_si256(at + third),
                                             color.bytes[third], mask));
    };
    // Thirds that nothing changes are written, too: where small polygons begin
    // and end a branch is guessed wrongly.
    blend(0, byte_mask<0>(bits));
    blend(1, byte_mask<1>(bits));
    blend(2, byte_mask<2>(bits));
  }

  /// Writes the colour from `to` on into `count` pixels, 32 at most. The
  /// image is not read: it is far away in memory. There are few branches, since
  /// small counts are predicted badly. So stores overlap, and some are made
  /// twice; each begins with the channel that is due there.
  static void put_run(std::uint8_t* to, int count, const FlatColor& color) {
    const int size = 3 * count;
    const auto before = [size](int k, int last) {
      return k < size - last ? k : size - last;
    };
    if (count <= 4) {
      for (int k = 0; k < 12; k += 3) {
        std::uint8_t* at = to + before(k, 3);
        scalar::store_pixel(at, color.packed);
      }
    } else if (count <= 10) {
      const __m128i first = _mm256_castsi256_si128(color.bytes[0]);
      for (int k = 0; k < 24; k += 6) {
        _mm_storel_epi64(reinterpret_cast<__m128i*>(to + before(k, 9)), first);
      }
      _mm_storel_epi64(reinterpret_cast<__m128i*>(to + size - 8),
                       _mm256_castsi256_si128(color.bytes[2]));
    } else {
      const auto at = [to](int byte) {
        return reinterpret_cast<__m256i*>(to + byte);
      };
      _mm256_storeu_si256(at(0), color.bytes[0]);
      if (size > 64) _mm256_storeu_si256(at(32), color.bytes[1]);
      _mm256_storeu_si256(at(size - 32), color.bytes[2]);
    }
  }

  /// Stores the colour at pixel k for every bit k, and reads nothing.
  static void store_runs(std::uint8_t* line, std::uint32_t bits,
                         const FlatColor& color) {
    std::uint64_t rest = bits;
    while (rest != 0) {
      const int first = __builtin_ctzll(rest);
      const int count = __builtin_ctzll(~(rest >> first));
      put_run(line + 3 * first, count, color);
      rest &= ~std::uint64_t{0} << (first + count);
    }
  }

  /// The colours of a line of a tile, on their way.
  struct ColorLine {
    __m256i bytes[3];
  };

  static ColorLine line_of(const FlatColor& color) {
    return {{color.bytes[0], color.bytes[1], color.bytes[2]}};
  }

  /// Lays the colour over the pixels `bits`.
  static void lay(ColorLine& line, std::uint32_t bits, const FlatColor& color) {
    const auto blend = [&](int third, __m256i mask) {
      line.bytes[third] =
          _mm256_blendv_epi8(line.bytes[third], color.bytes[third], mask);
    };
    blend(0, byte_mask<0>(bits));
    blend(1, byte_mask<1>(bits));
    blend(2, byte_mask<2>(bits));
  }

  static void store(std::uint8_t* to, const ColorLine& line) {
    for (int k = 0; k < 3; ++k) {
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(to) + k, line.bytes[k]);
    }
  }

  /// Whether stores leave alone, unread, what a mask leaves out.
  static constexpr bool kMaskedStores = false;

  /// Stores 24 bytes.
  static void store_eight(std::uint8_t* to, __m256i colors) {
    auto* out = reinterpret_cast<__m128i*>(to);
    _mm_storeu_si128(out, _mm256_castsi256_si128(colors));
    _mm_storel_epi64(out + 1, _mm256_extracti128_si256(colors, 1));
  }

  /// The same for the pixels `eight` alone. `whole`: all 8 are there.
  static void store_some(std::uint8_t* to, __m256i colors, std::uint32_t eight,
                         bool whole) {
    if (!whole) {
      alignas(32) std::uint8_t bytes[32];
      _mm256_store_si256(reinterpret_cast<__m256i*>(bytes), colors);
      for (std::uint32_t rest = eight; rest != 0; rest &= rest - 1) {
        const int pixel = __builtin_ctz(rest);
        for (int c = 0; c < 3; ++c) to[3 * pixel + c] = bytes[3 * pixel + c];
      }
      return;
    }
    auto* in = reinterpret_cast<const __m128i*>(to);
    const __m256i old =
        _mm256_set_m128i(_mm_loadl_epi64(in + 1), _mm_loadu_si128(in));
    store_eight(to, _mm256_blendv_epi8(old, colors, byte_mask<0>(eight)));
  }
};

}  // namespace
}  // namespace halfspace::fast
