#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "halfspace/ref/rational.hpp"

namespace halfspace::ref {

/// The number that a double is. Requires: it is finite.
inline Rational rational_of(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  Rational number(static_cast<std::int64_t>(std::ldexp(mantissa, 53)));
  const Rational two_to_32 = std::int64_t{1} << 32;
  for (exponent -= 53; exponent >= 32; exponent -= 32) number *= two_to_32;
  for (; exponent <= -32; exponent += 32) number = number / two_to_32;
  const Rational rest = std::int64_t{1} << std::abs(exponent);
  return exponent < 0 ? number / rest : number * rest;
}

}  // namespace halfspace::ref
