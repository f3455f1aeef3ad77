#pragma once

#include <cstdint>
#include <numeric>
#include <utility>

#include "exact/wide.hpp"

namespace halfspace::fast {

/// The magnitude of `value`.
inline Uint128 size_of(Int128 value) {
  return value < 0 ? -static_cast<Uint128>(value) : static_cast<Uint128>(value);
}
inline std::uint64_t size_of(std::int64_t value) {
  return value < 0 ? -static_cast<std::uint64_t>(value)
                   : static_cast<std::uint64_t>(value);
}

/// The greatest common divisor; 0 if both are 0. Exact.
inline std::uint64_t greatest_common_divisor(std::uint64_t a, std::uint64_t b) {
  return std::gcd(a, b);
}
/// The same, in 64 bits as soon as both numbers fit them.
inline Uint128 greatest_common_divisor(Uint128 a, Uint128 b) {
  while (b != 0) {
    if (((a | b) >> 64) == 0) {
      return std::gcd(static_cast<std::uint64_t>(a),
                      static_cast<std::uint64_t>(b));
    }
    a %= b;
    std::swap(a, b);
  }
  return a;
}

}  // namespace halfspace::fast
