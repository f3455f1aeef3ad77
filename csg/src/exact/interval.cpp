#include "halfspace/csg/interval.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace halfspace::csg {

double nearest_double(const Integer& numerator, const Integer& denominator) {
  if (numerator == 0) return 0;
  Integer size = abs(numerator);
  // A quotient of 66 bits or 65, whose last one says whether a rest is left.
  const int shift =
      static_cast<int>(msb(denominator)) - static_cast<int>(msb(size)) + 65;
  Integer below = denominator;
  if (shift > 0) size <<= shift;
  if (shift < 0) below <<= -shift;
  Integer rest;
  Integer quotient;
  divide_qr(size, below, quotient, rest);
  const int drop = static_cast<int>(msb(quotient)) + 1 - 53;
  const Integer half = Integer(1) << (drop - 1);
  Integer kept = quotient >> drop;
  const Integer lost = quotient - (kept << drop);
  const bool odd = bit_test(kept, 0);
  if (lost > half || (lost == half && (rest != 0 || odd))) ++kept;
  const double value = std::ldexp(
      static_cast<double>(static_cast<std::uint64_t>(kept)), drop - shift);
  return numerator < 0 ? -value : value;
}

Interval IntervalArithmetic::quotient(const Integer& numerator,
                                      const Integer& denominator) const {
  const Integer shifted = numerator << bits_;
  Interval result{shifted / denominator, 0};
  if (denominator != 1 && shifted % denominator != 0) result.radius = 1;
  return result;
}

Interval IntervalArithmetic::product(const Interval& a,
                                     const Interval& b) const {
  const Integer spread =
      abs(a.middle) * b.radius + abs(b.middle) * a.radius + a.radius * b.radius;
  return {Integer(a.middle * b.middle) >> bits_, Integer(spread >> bits_) + 2};
}

Interval IntervalArithmetic::divided(const Interval& a,
                                     const Integer& by) const {
  return {a.middle / by, a.radius / abs(by) + 2};
}

Interval IntervalArithmetic::divided(const Interval& a,
                                     const Interval& b) const {
  // |a/b - A/B| <= (|A| rb + |B| ra) / (|B| (|B| - rb)).
  const Integer size = abs(b.middle);
  const Integer spread = abs(a.middle) * b.radius + size * a.radius;
  return {Integer(a.middle << bits_) / b.middle,
          Integer(spread << bits_) / (size * (size - b.radius)) + 2};
}

Interval IntervalArithmetic::root(const Integer& value) const {
  return {sqrt(Integer(value << (2 * bits_))), 1};
}

std::optional<double> IntervalArithmetic::nearest(
    const Interval& a, const Integer& numerator,
    const Integer& denominator) const {
  const Integer below = denominator << bits_;
  const double low = nearest_double((a.middle - a.radius) * numerator, below);
  const double high = nearest_double((a.middle + a.radius) * numerator, below);
  if (low != high) return std::nullopt;
  return low;
}

Scale scale_of(const Unit& unit, int power) {
  const Integer size =
      pow(Integer(unit.base),
          static_cast<unsigned>(std::abs(unit.exponent) * power));
  if (unit.exponent >= 0) return {size, 1};
  return {1, size};
}

}  // namespace halfspace::csg
