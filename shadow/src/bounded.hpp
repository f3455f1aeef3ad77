#pragma once

#include <cmath>

#include "halfspace/int128.hpp"

namespace halfspace::shadow {

/// A real number that is `value`, give or take `error`.
///
/// A rounded sum, product or quotient r has an error of at most u |r|, u =
/// 2^-53, or less than kTiny where it is subnormal. Errors are sums of at most
/// six such terms, which are rounded too: that loses less than 2^-48 of them,
/// and kSlack restores it. NaN and infinity are never certain. Source: SHE97.
struct Bounded {
  double value = 0;
  double error = 0;
};

constexpr double kUnit = 0x1p-53;
constexpr double kSlack = 1 + 0x1p-40;
constexpr double kTiny = 1e-300;

inline Bounded exactly(double value) { return {value, 0}; }

inline Bounded bounded(Int128 value) {
  const auto rounded = static_cast<double>(value);
  return {rounded,
          std::abs(rounded) <= 0x1p53 ? 0 : kUnit * kSlack * std::abs(rounded)};
}

inline Bounded operator-(const Bounded& a) { return {-a.value, a.error}; }

inline Bounded operator+(const Bounded& a, const Bounded& b) {
  const double sum = a.value + b.value;
  return {sum, kSlack * (a.error + b.error + kUnit * std::abs(sum)) + kTiny};
}

inline Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }

inline Bounded operator*(const Bounded& a, const Bounded& b) {
  const double product = a.value * b.value;
  return {product, kSlack * (std::abs(a.value) * b.error +
                             (std::abs(b.value) + b.error) * a.error +
                             kUnit * std::abs(product)) +
                       kTiny};
}

/// Where b may be zero, the error is NaN or infinite.
inline Bounded operator/(const Bounded& a, const Bounded& b) {
  const double quotient = a.value / b.value;
  // From |A/B - a/b| <= (error of a + |a/b| error of b) / |B|.
  const double least = std::abs(b.value) - 2 * b.error;
  if (!(least > 0)) return {0, HUGE_VAL};
  return {quotient,
          kSlack * ((a.error + std::abs(quotient) * kSlack * b.error) / least +
                    kUnit * std::abs(quotient)) +
              kTiny};
}

inline bool is_positive(const Bounded& a) { return a.value > a.error; }
inline bool is_negative(const Bounded& a) { return -a.value > a.error; }

}  // namespace halfspace::shadow
