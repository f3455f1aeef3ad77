#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "exact/wide.hpp"

/// Quotients of exact numbers, rounded once.
namespace halfspace::fast {

/// The number of bits of a value that is not negative, without leading zeros.
template <std::size_t kWords>
int bit_count(const Wide<kWords>& a) {
  std::size_t top = kWords;
  while (top > 0 && a.words[top - 1] == 0) --top;
  return top == 0
             ? 0
             : static_cast<int>(top) * 64 - std::countl_zero(a.words[top - 1]);
}

template <std::size_t kWords>
Wide<kWords> shifted_up(const Wide<kWords>& a, int bits) {
  const auto words = static_cast<std::size_t>(bits / 64);
  const int rest = bits % 64;
  Wide<kWords> result;
  for (std::size_t i = words; i < kWords; ++i) {
    result.words[i] = a.words[i - words] << rest;
    if (rest > 0 && i > words)
      result.words[i] |= a.words[i - words - 1] >> (64 - rest);
  }
  return result;
}

/// Appends the next `count` binary digits of the quotient rest / d to `digits`,
/// and leaves the remainder: a step of long division.
///
/// Requires: 0 <= rest < d; count <= 30.
template <std::size_t kWords>
void take_digits(int count, const Wide<kWords>& d, Wide<kWords>& rest,
                 std::uint64_t& digits) {
  rest = shifted_up(rest, count);
  // Both doubles are off by 2^-52 of themselves, so the quotient is off by less
  // than one.
  auto next = static_cast<std::int64_t>(to_double(rest) / to_double(d));
  rest = rest - multiply<kWords>(d, Int128{next});
  for (; rest.is_negative(); --next) rest = rest + d;
  for (; !(rest - d).is_negative(); ++next) rest = rest - d;
  digits = (digits << count) + static_cast<std::uint64_t>(next);
}

/// n / d as the nearest double, ties to even.
///
/// Requires: d > 0, the quotient at most 2^54 in size.
template <std::size_t kWords>
double exact_quotient(const Wide<kWords>& n, const Wide<kWords>& d,
                      bool& rounded) {
  const int sign_of_n = sign(n);
  if (sign_of_n == 0) return 0;
  // Step 1: shift one of them up until the quotient is from 1 to below 2.
  using More = Wide<kWords + 1>;
  More rest(sign_of_n < 0 ? -n : n);
  More by(d);
  int exponent = bit_count(rest) - bit_count(by);
  if (exponent > 0) {
    by = shifted_up(by, exponent);
  } else {
    rest = shifted_up(rest, -exponent);
  }
  if ((rest - by).is_negative()) {
    rest = rest + rest;
    --exponent;
  }
  // Step 2: 53 digits, the first of which is 1, and one to round by.
  rest = rest - by;
  std::uint64_t digits = 1;
  take_digits(27, by, rest, digits);
  take_digits(26, by, rest, digits);
  const bool half = digits % 2 != 0;
  const bool more = sign(rest) != 0;
  rounded = half || more;
  digits /= 2;
  if (half && (more || digits % 2 != 0)) ++digits;
  return sign_of_n * static_cast<double>(digits) * power_of_two(exponent - 52);
}

/// The highest 128 bits of a value that is not negative, from its leading one
/// on, and the exponent of `high`.
struct Head {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  int exponent = 0;
};
template <std::size_t kWords>
Head head_of(const Wide<kWords>& a) {
  std::size_t top = kWords - 1;
  while (top > 0 && a.words[top] == 0) --top;
  const auto word = [&](std::size_t below) {
    return top >= below ? a.words[top - below] : 0;
  };
  if (a.words[top] == 0) return {};
  const int zeros = std::countl_zero(a.words[top]);
  Head head{word(0), word(1), static_cast<int>(top) * 64 - zeros};
  if (zeros > 0) {
    head.high = head.high << zeros | head.low >> (64 - zeros);
    head.low = head.low << zeros | word(2) >> (64 - zeros);
  }
  return head;
}

/// The same from the highest bits alone, or 0 where they do not decide how to
/// round. The answer is never exact.
///
/// With N and D the heads, q = N / 2D in whole numbers. The true quotient is
/// less than q + 1 for the fraction of q, one more for the dropped bits of N,
/// and more than q - 2 for those of D, which are 2^-63 of it, as q < 2^64. So
/// it is off by less than 3, and q has 63 bits or 64.
template <std::size_t kWords>
double quick_quotient(const Wide<kWords>& n, const Wide<kWords>& d) {
  constexpr std::uint64_t kDoubt = 3;
  const bool negative = n.is_negative();
  const Head over = head_of(negative ? -n : n);
  const Head under = head_of(d);
  if (over.high == 0 || under.high == 0) return 0;
  const Uint128 half = (Uint128{over.high} << 64 | over.low) >> 1;
  const auto q = static_cast<std::uint64_t>(half / under.high);
  const int dropped = 64 - std::countl_zero(q) - 53;
  const std::uint64_t rest = q & ((std::uint64_t{1} << dropped) - 1);
  const std::uint64_t tie = std::uint64_t{1} << (dropped - 1);
  const bool up = rest > tie;
  // Neither nearly a double nor nearly between two of them.
  if (rest <= kDoubt || rest + kDoubt >= 2 * tie ||
      (up ? rest - tie : tie - rest) <= kDoubt)
    return 0;
  const std::uint64_t digits = (q >> dropped) + (up ? 1 : 0);
  const double value =
      static_cast<double>(digits) *
      power_of_two(dropped + 1 + over.exponent - under.exponent - 64);
  return negative ? -value : value;
}

/// n / d as the nearest double, ties to even. `rounded`: it is not exact.
///
/// Requires: d > 0, the quotient at most 2^54 in size.
template <std::size_t kWords>
double quotient(const Wide<kWords>& n, const Wide<kWords>& d, bool& rounded) {
  const double quick = quick_quotient(n, d);
  rounded = quick != 0;
  return rounded ? quick : exact_quotient(n, d, rounded);
}

}  // namespace halfspace::fast
