#include <bit>
#include <cmath>
#include <cstdint>

#include "space.hpp"

namespace halfspace::fast {
namespace {

/// How many bits a value that is not negative has, up to its first one.
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

/// Moves so many digits from the rest of n / d to those in front of it.
///
/// Requires: 0 <= rest < d, no more than 30 digits.
template <std::size_t kWords>
void take_digits(int count, const Wide<kWords>& d, Wide<kWords>& rest,
                 std::uint64_t& digits) {
  rest = shifted_up(rest, count);
  // Off by less than one: either double by 2^-52 of itself, and the quotient.
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
double quotient(const Wide<kWords>& n, const Wide<kWords>& d, bool& rounded) {
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
  rounded = rounded || half || more;
  digits /= 2;
  if (half && (more || digits % 2 != 0)) ++digits;
  return sign_of_n * std::ldexp(static_cast<double>(digits), exponent - 52);
}

}  // namespace

std::array<double, 3> Space::nearest(std::int32_t id, bool& rounded) const {
  rounded = false;
  const SpaceVertex& v = vertex(id);
  if (v.is_grid()) return {v.approximate.x, v.approximate.y, v.approximate.z};
  return with_grid(grid_bits_, [&](auto bits) {
    constexpr std::size_t kWords = Grid<bits()>::kWords;
    std::array<Wide<kWords>, 4> c;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t w = 0; w < kWords; ++w)
        c[i].words[w] = exact_[v.exact + i * kWords + w];
    }
    return std::array<double, 3>{quotient(c[0], c[3], rounded),
                                 quotient(c[1], c[3], rounded),
                                 quotient(c[2], c[3], rounded)};
  });
}

}  // namespace halfspace::fast
