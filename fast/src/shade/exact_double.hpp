#pragma once

#include <cmath>
#include <cstdint>

#include "exact/big_rational.hpp"

namespace halfspace::fast {

/// The number that a double is. Requires: it is finite.
inline BigRational exact_double(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  const BigInteger integer =
      static_cast<std::int64_t>(std::ldexp(mantissa, 53));
  exponent -= 53;
  if (exponent >= 0) {
    const BigInteger scaled = integer << static_cast<unsigned>(exponent);
    return scaled;
  }
  return {integer, BigInteger(1) << static_cast<unsigned>(-exponent)};
}

}  // namespace halfspace::fast
