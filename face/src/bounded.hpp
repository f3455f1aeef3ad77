#pragma once

#include <cmath>
#include <cstdint>

#include "halfspace/int128.hpp"

namespace halfspace::detail {

/// A number that is known to within `error`: |value - (high + low)| <= error.
///
/// Two doubles that do not overlap (SHE97) and a running bound. Each operation
/// adds the sizes of what its own roundings lose: a sum or product of doubles
/// that is rounded to r is off by at most u|r|, u = 2^-53. The bounds are sums
/// of at most a dozen such terms, none negative, each off by 12u at most when
/// it is itself computed; kSlack pays for that.
/// Requires, of all operations: no double in between is beyond 2^1000 or, but
///           for 0, below 2^-900, where products would lose digits unseen.
struct Bounded {
  double high = 0;
  double low = 0;
  double error = 0;

  double size() const { return std::abs(high) + std::abs(low); }
};

constexpr double kUnitRoundoff = 0x1p-53;
constexpr double kSlack = 1 + 0x1p-48;

/// The sum, rounded, and what that lost, exactly (SHE97, theorem 7).
inline Bounded exact_sum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part), 0};
}

/// The product, rounded, and what that lost, exactly (SHE97, theorem 18; here
/// by a fused multiplication and addition).
inline Bounded exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product), 0};
}

inline Bounded operator-(const Bounded& a) {
  return {-a.high, -a.low, a.error};
}

inline Bounded operator+(const Bounded& a, const Bounded& b) {
  const Bounded sum = exact_sum(a.high, b.high);
  const double lows = a.low + b.low;
  const double rest = sum.low + lows;
  Bounded result = exact_sum(sum.high, rest);
  result.error = kSlack * (a.error + b.error +
                           kUnitRoundoff * (std::abs(lows) + std::abs(rest)));
  // Nothing is lost where there are no low parts.
  if (lows == 0 && a.low == 0) result.error = kSlack * (a.error + b.error);
  return result;
}

inline Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }

inline Bounded operator*(const Bounded& a, const Bounded& b) {
  const Bounded product = exact_product(a.high, b.high);
  const double left = a.high * b.low, right = a.low * b.high;
  const double cross = left + right;
  const double rest = product.low + cross;
  Bounded result = exact_sum(product.high, rest);
  result.error =
      kSlack * (a.size() * b.error + b.size() * a.error + a.error * b.error +
                std::abs(a.low * b.low) +
                (cross == 0 && left == 0
                     ? 0
                     : kUnitRoundoff * (std::abs(left) + std::abs(right) +
                                        std::abs(cross) + std::abs(rest))));
  return result;
}

/// Whether it is certain that the number is not 0.
inline bool is_not_zero(const Bounded& a) {
  return std::abs(a.high) * (1 - 0x1p-50) > std::abs(a.low) + a.error;
}

/// Two steps of long division; what is left after them is in the bound.
/// Requires: is_not_zero(b).
inline Bounded operator/(const Bounded& a, const Bounded& b) {
  const double first = a.high / b.high;
  const Bounded rest = a - b * Bounded{first};
  const double second = rest.high / b.high;
  const Bounded left = rest - b * Bounded{second};
  Bounded result = exact_sum(first, second);
  const double least =
      (std::abs(b.high) - std::abs(b.low) - b.error) * (1 - 0x1p-50);
  result.error = kSlack * ((left.size() + left.error) / least);
  return result;
}

/// Exact.
inline Bounded bounded(std::int64_t value) {
  const auto high = static_cast<double>(value);
  // Below 2^53 all of it; else the rest, which is less than 2^11.
  const Int128 rest = Int128{value} - static_cast<Int128>(high);
  return {high, static_cast<double>(rest), 0};
}

inline Bounded bounded(Int128 value) {
  const auto high = static_cast<double>(value);
  const Int128 rest = value - static_cast<Int128>(high);
  const auto low = static_cast<double>(rest);
  const bool is_exact = static_cast<Int128>(low) == rest;
  return {high, low, is_exact ? 0 : 2 * kUnitRoundoff * std::abs(low)};
}

/// The double next to the number, in `nearest`, if there is no doubt which one
/// that is and it is not 0 or next to it.
///
/// The true value is between high + (low - e) and high + (low + e) where e is a
/// little more than the error, by more than the rounding of either bracket.
/// Rounding is monotonic: where both sums come to one double, so does it.
inline bool is_certain(const Bounded& value, double& nearest) {
  const double margin =
      value.error * (1 + 0x1p-50) + std::abs(value.low) * 0x1p-51;
  const double least = value.high + (value.low - margin);
  nearest = value.high + (value.low + margin);
  return least == nearest && std::abs(nearest) > 0x1p-800 &&
         std::abs(nearest) < 0x1p800;
}

}  // namespace halfspace::detail
