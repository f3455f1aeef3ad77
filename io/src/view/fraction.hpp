#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>

#include "halfspace/io/number.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::io {

using Fraction = boost::multiprecision::cpp_rational;

inline Integer power(int base, std::int32_t exponent) {
  return boost::multiprecision::pow(Integer(base),
                                    static_cast<unsigned>(exponent));
}

/// A grid step in model units.
inline Fraction grid_step(const Unit& unit) {
  return unit.exponent >= 0
             ? Fraction(power(unit.base, unit.exponent))
             : Fraction(Integer(1), power(unit.base, -unit.exponent));
}

inline Fraction fraction_of(const Number& number) {
  Fraction exact(number.mantissa);
  const auto scale = [&exact](int base, std::int32_t exponent) {
    if (exponent >= 0) {
      exact *= power(base, exponent);
    } else {
      exact /= power(base, -exponent);
    }
  };
  scale(2, number.two);
  scale(5, number.five);
  return exact;
}

/// The nearest integer; halves go up.
inline Integer rounded(const Fraction& value) {
  const Fraction up = value + Fraction(1, 2);
  Integer result = numerator(up) / denominator(up);
  if (result * denominator(up) > numerator(up)) result -= 1;
  return result;
}

}  // namespace halfspace::io
