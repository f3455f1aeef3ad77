#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "halfspace/int128.hpp"

namespace halfspace::fast {

__extension__ typedef unsigned __int128 Uint128;

/// Whether no instruction gives both words of a product: then it pays always,
/// not only for many words, to look how long numbers are (multiply_short()).
#if defined(__wasm__)
constexpr bool kSlowProducts = true;
#else
constexpr bool kSlowProducts = false;
#endif

/// The low word of a * b + add + carry; its high word becomes the carry.
template <bool kSlow = kSlowProducts>
std::uint64_t multiply_words(std::uint64_t a, std::uint64_t b,
                             std::uint64_t add, std::uint64_t& carry) {
  if constexpr (!kSlow) {
    const Uint128 t = Uint128{a} * b + add + carry;
    carry = static_cast<std::uint64_t>(t >> 64);
    return static_cast<std::uint64_t>(t);
  }
  constexpr std::uint64_t kHalf = 0xffffffff;
  const std::uint64_t a0 = a & kHalf, a1 = a >> 32;
  const std::uint64_t b0 = b & kHalf, b1 = b >> 32;
  const std::uint64_t low = a0 * b0;
  const std::uint64_t left = a1 * b0, right = a0 * b1;
  const std::uint64_t middle = (low >> 32) + (left & kHalf) + (right & kHalf);
  std::uint64_t high = a1 * b1 + (left >> 32) + (right >> 32) + (middle >> 32);
  std::uint64_t word = (low & kHalf) | (middle << 32);
  word += add;
  high += word < add ? 1u : 0u;
  word += carry;
  high += word < carry ? 1u : 0u;
  carry = high;
  return word;
}

/// a * b.
inline Int128 product_of(std::int64_t a, std::int64_t b) {
  if constexpr (!kSlowProducts) return Int128{a} * b;
  std::uint64_t high = 0;
  const std::uint64_t low = multiply_words(
      static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b), 0, high);
  if (a < 0) high -= static_cast<std::uint64_t>(b);
  if (b < 0) high -= static_cast<std::uint64_t>(a);
  return static_cast<Int128>((Uint128{high} << 64) | low);
}

/// Whether the value is less than 2^62 in size, about.
constexpr bool is_short(Int128 value) {
  return value == static_cast<std::int64_t>(value) &&
         value < (std::int64_t{1} << 62) && value > -(std::int64_t{1} << 62);
}

/// A signed integer of `kWords` words of 64 bits in two's complement, least
/// word first. Lives in registers or on the stack; nothing allocates.
///
/// Requires: every value computed fits. The bits are counted where each width
///           is chosen; nothing is checked here.
template <std::size_t kWords>
struct Wide {
  std::array<std::uint64_t, kWords> words{};

  constexpr Wide() = default;
  constexpr Wide(std::int64_t value) : Wide(static_cast<Int128>(value)) {}
  constexpr Wide(int value) : Wide(static_cast<Int128>(value)) {}
  constexpr Wide(Int128 value) {
    static_assert(kWords >= 2);
    words[0] = static_cast<std::uint64_t>(value);
    words[1] = static_cast<std::uint64_t>(value >> 64);
    for (std::size_t i = 2; i < kWords; ++i) words[i] = fill(value < 0);
  }
  /// The same value with more words, or with fewer where it fits them.
  template <std::size_t kOther>
  constexpr explicit Wide(const Wide<kOther>& other) {
    for (std::size_t i = 0; i < kWords; ++i) {
      words[i] = i < kOther ? other.words[i] : fill(other.is_negative());
    }
  }

  constexpr bool is_negative() const { return (words[kWords - 1] >> 63) != 0; }

  friend constexpr Wide operator+(const Wide& a, const Wide& b) {
    Wide sum;
    unsigned long long carry = 0;
    for (std::size_t i = 0; i < kWords; ++i) {
      const Uint128 s = Uint128{a.words[i]} + b.words[i] + carry;
      sum.words[i] = static_cast<std::uint64_t>(s);
      carry = static_cast<unsigned long long>(s >> 64);
    }
    return sum;
  }
  friend constexpr Wide operator-(const Wide& a, const Wide& b) {
    Wide difference;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < kWords; ++i) {
      const Uint128 d = Uint128{a.words[i]} - b.words[i] - borrow;
      difference.words[i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1u;
    }
    return difference;
  }
  friend constexpr Wide operator-(const Wide& a) { return Wide{} - a; }
  friend constexpr bool operator==(const Wide&, const Wide&) = default;

 private:
  static constexpr std::uint64_t fill(bool negative) {
    return negative ? ~std::uint64_t{0} : 0;
  }
};

/// The sign of a value: -1, 0 or 1.
template <std::size_t kWords>
constexpr int sign(const Wide<kWords>& a) {
  if (a.is_negative()) return -1;
  std::uint64_t any = 0;
  for (const std::uint64_t word : a.words) any |= word;
  return any != 0 ? 1 : 0;
}
constexpr int sign(Int128 a) { return a > 0 ? 1 : a < 0 ? -1 : 0; }

/// The magnitude of a value that is not the least there is.
template <std::size_t kWords>
constexpr Wide<kWords> size_of(const Wide<kWords>& a) {
  return a.is_negative() ? -a : a;
}

/// How many words hold the value with its sign.
template <std::size_t kWords>
std::size_t length_of(const Wide<kWords>& a) {
  const std::uint64_t fill = a.is_negative() ? ~std::uint64_t{0} : 0;
  std::size_t length = kWords;
  while (length > 1 && a.words[length - 1] == fill &&
         (a.words[length - 2] >> 63) == (fill & 1)) {
    --length;
  }
  return length;
}

/// multiply() below, of as many words as the values have: for numbers that are
/// mostly far shorter than they may be.
template <std::size_t kResult, std::size_t kA, std::size_t kB>
Wide<kResult> multiply_short(const Wide<kA>& a, const Wide<kB>& b) {
  const std::size_t a_length = length_of(a), b_length = length_of(b);
  const std::size_t full =
      a_length + b_length < kResult ? a_length + b_length : kResult;
  Wide<kResult> product;
  for (std::size_t i = 0; i < a_length && i < full; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b_length && i + j < full; ++j) {
      product.words[i + j] =
          multiply_words(a.words[i], b.words[j], product.words[i + j], carry);
    }
    if (i + b_length < full) product.words[i + b_length] = carry;
  }
  const auto subtract = [&](const auto& value, std::size_t length,
                            std::size_t shift) {
    std::uint64_t borrow = 0;
    for (std::size_t i = shift; i < full && i - shift < length; ++i) {
      const Uint128 d =
          Uint128{product.words[i]} - value.words[i - shift] - borrow;
      product.words[i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1u;
    }
  };
  if (a.is_negative()) subtract(b, b_length, a_length);
  if (b.is_negative()) subtract(a, a_length, b_length);
  const bool negative = (product.words[full - 1] >> 63) != 0;
  for (std::size_t i = full; i < kResult; ++i)
    product.words[i] = negative ? ~std::uint64_t{0} : 0;
  return product;
}

/// a * b in `kResult` words.
///
/// The words are multiplied as if unsigned. With A words in a, reading a < 0 as
/// unsigned adds 2^(64 A), so b * 2^(64 A) is subtracted again; and the same
/// for b. The product of both excesses lies beyond A + B words.
template <std::size_t kResult, std::size_t kA, std::size_t kB>
constexpr Wide<kResult> multiply(const Wide<kA>& a, const Wide<kB>& b) {
  if constexpr (kSlowProducts) {
    if (!std::is_constant_evaluated()) return multiply_short<kResult>(a, b);
  }
  constexpr std::size_t kFull = kA + kB < kResult ? kA + kB : kResult;
  Wide<kFull> product;
  for (std::size_t i = 0; i < kA && i < kFull; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < kB && i + j < kFull; ++j) {
      const Uint128 t =
          Uint128{a.words[i]} * b.words[j] + product.words[i + j] + carry;
      product.words[i + j] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    if (i + kB < kFull) product.words[i + kB] = carry;
  }
  const auto subtract = [&product](const auto& value, std::size_t shift) {
    std::uint64_t borrow = 0;
    for (std::size_t i = shift; i < kFull && i - shift < value.words.size();
         ++i) {
      const Uint128 d =
          Uint128{product.words[i]} - value.words[i - shift] - borrow;
      product.words[i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1u;
    }
  };
  if (a.is_negative()) subtract(b, kA);
  if (b.is_negative()) subtract(a, kB);
  return Wide<kResult>(product);
}
template <std::size_t kResult>
constexpr Wide<kResult> multiply(Int128 a, Int128 b) {
  return multiply<kResult>(Wide<2>(a), Wide<2>(b));
}
template <std::size_t kResult, std::size_t kB>
constexpr Wide<kResult> multiply(Int128 a, const Wide<kB>& b) {
  return multiply<kResult>(Wide<2>(a), b);
}
template <std::size_t kResult, std::size_t kA>
constexpr Wide<kResult> multiply(const Wide<kA>& a, Int128 b) {
  return multiply<kResult>(a, Wide<2>(b));
}

/// Requires: it is a normal double.
constexpr double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent)
                               << 52);
}

/// The value as a double: off by at most 2^-52 of its size.
///
/// The highest 64 bits from the leading one are kept, which drops less than
/// 2^-63 of the value, and rounded once to 53, by at most 2^-53.
template <std::size_t kWords>
double to_double(const Wide<kWords>& a) {
  const bool negative = a.is_negative();
  const Wide<kWords> size = negative ? -a : a;
  std::size_t top = kWords;
  while (top > 0 && size.words[top - 1] == 0) --top;
  if (top == 0) return 0;
  const int zeros = __builtin_clzll(size.words[top - 1]);
  std::uint64_t head = size.words[top - 1] << zeros;
  if (zeros > 0 && top > 1) head |= size.words[top - 2] >> (64 - zeros);
  const double value = static_cast<double>(head) *
                       power_of_two(static_cast<int>(top - 1) * 64 - zeros);
  return negative ? -value : value;
}
inline double to_double(Int128 a) {
  // Both parts of up to 92 bits are doubles exactly, so their sum rounds once.
  constexpr int kLow = 40;
  const Int128 high = a >> kLow;
  if (high >> 52 != 0 && high >> 52 != -1) return static_cast<double>(a);
  const auto low = static_cast<std::int64_t>(a - (high << kLow));
  return static_cast<double>(static_cast<std::int64_t>(high)) * 0x1p40 +
         static_cast<double>(low);
}
inline double to_double(std::int64_t a) { return static_cast<double>(a); }

}  // namespace halfspace::fast
