#include "halfspace/ref/big_rational.hpp"

#include <algorithm>
#include <cmath>

namespace halfspace::ref {

BigInteger floor_of(const BigRational& value) {
  const BigInteger whole = numerator(value);
  const BigInteger part = denominator(value);
  BigInteger quotient = whole / part;  // towards zero
  if (whole < 0 && quotient * part != whole) quotient -= 1;
  return quotient;
}

double nearest_double(const BigRational& value) {
  if (value == 0) return 0;
  const BigInteger above = abs(numerator(value));
  const BigInteger below = denominator(value);
  BigInteger quotient, rest, divisor;
  const auto divide_by_power_of_2 = [&](int exponent) {
    divisor = exponent > 0 ? BigInteger(below << exponent) : below;
    const BigInteger dividend =
        exponent < 0 ? BigInteger(above << -exponent) : above;
    divide_qr(dividend, divisor, quotient, rest);
  };
  // A double is an integer of 53 bits times a power of two, of 2^-1074 or more.
  // The estimate of the power, from the lengths, is right or one too great.
  const int length =
      static_cast<int>(msb(above)) - static_cast<int>(msb(below));
  int exponent = std::max(length - 52, -1074);
  divide_by_power_of_2(exponent);
  if (exponent > -1074 && quotient < BigInteger(1) << 52) {
    divide_by_power_of_2(--exponent);
  }
  const BigInteger twice = 2 * rest;
  if (twice > divisor || (twice == divisor && quotient % 2 != 0)) quotient += 1;
  const double magnitude = std::ldexp(quotient.convert_to<double>(), exponent);
  return value < 0 ? -magnitude : magnitude;
}

}  // namespace halfspace::ref
