#include <cmath>

#include "space.hpp"

namespace halfspace::fast {
namespace {

/// n / d as the nearest double, ties to even, digit by digit.
///
/// Requires: d > 0, the quotient at most 2^54 in size. Twice n fits.
template <std::size_t kWords>
double quotient(Wide<kWords> n, Wide<kWords> d, bool& rounded) {
  const int sign_of_n = sign(n);
  if (sign_of_n == 0) return 0;
  if (sign_of_n < 0) n = -n;
  int exponent = 0;  // of the digit to come
  while (sign(n - d) >= 0) {
    d = d + d;
    ++exponent;
  }
  std::uint64_t digits = 0;
  // 53 digits from the first that is not 0, and one to round by.
  while (digits >> 53 == 0) {
    const auto rest = n - d;
    const bool one = !rest.is_negative();
    digits = 2 * digits + (one ? 1 : 0);
    if (one) n = rest;
    n = n + n;
    --exponent;
  }
  const bool half = digits % 2 != 0;
  const bool more = sign(n) != 0;
  rounded = rounded || half || more;
  digits /= 2;
  if (half && (more || digits % 2 != 0)) ++digits;
  // The digit after the last one has the weight 2^exponent.
  return sign_of_n * std::ldexp(static_cast<double>(digits), exponent + 2);
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
