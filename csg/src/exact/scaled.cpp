#include "halfspace/csg/scaled.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "halfspace/csg/interval.hpp"

namespace halfspace::csg {
namespace {

/// The quotient to the nearest integer; halves go away from zero.
Integer rounded_quotient(const Integer& above, const Integer& below) {
  return (2 * above + below) / (2 * below);
}

Integer power_of_ten(int exponent) {
  return pow(Integer(10), static_cast<unsigned>(exponent));
}

/// `digits` digits of a positive fraction, the first of which is not 0, and the
/// power of ten of the first one.
std::pair<std::string, int> digits_of(const Integer& above,
                                      const Integer& below, int digits) {
  // By bits, to within one: a bit is 0.30103 of a digit.
  constexpr double kDigitsOfBit = 0.30102999566398120;
  int exponent = static_cast<int>(
      std::floor(kDigitsOfBit * (static_cast<double>(msb(above)) -
                                 static_cast<double>(msb(below)))));
  for (--exponent;; ++exponent) {
    const int shift = digits - 1 - exponent;
    std::string text =
        rounded_quotient(
            shift > 0 ? Integer(above * power_of_ten(shift)) : above,
            shift < 0 ? Integer(below * power_of_ten(-shift)) : below)
            .str();
    if (text.size() <= static_cast<std::size_t>(digits))
      return {std::move(text), exponent};
  }
}

}  // namespace

double Scaled::value() const {
  if (steps == 0) return 0;
  // In two halves: the power alone may be beyond doubles where this is not.
  const int exponent = power * unit.exponent;
  const auto base = static_cast<double>(unit.base);
  return steps * std::pow(base, exponent / 2) *
         std::pow(base, exponent - exponent / 2);
}

bool Scaled::is_double() const { return steps == 0 || std::isnormal(value()); }

std::string to_string(const Scaled& value, int digits) {
  char place[40];
  if (value.is_double()) {
    std::snprintf(place, sizeof place, "%.*g", digits, value.value());
    return place;
  }
  constexpr int kBits = 53;
  int exponent = 0;
  const double fraction = std::frexp(std::abs(value.steps), &exponent);
  Integer above = static_cast<std::int64_t>(std::ldexp(fraction, kBits));
  Integer below = 1;
  exponent -= kBits;
  (exponent > 0 ? above : below) <<= std::abs(exponent);
  const Scale scale = scale_of(value.unit, value.power);
  above *= scale.numerator;
  below *= scale.denominator;
  auto [text, ten] = digits_of(above, below, digits);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.size() > 1) text.insert(1, ".");
  std::snprintf(place, sizeof place, "e%+03d", ten);
  return (value.steps < 0 ? "-" : "") + text + place;
}

}  // namespace halfspace::csg
