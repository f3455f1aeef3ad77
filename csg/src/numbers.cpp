#include "numbers.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "halfspace/csg/matrix.hpp"

namespace halfspace::csg {

using io::Integer;
using io::Number;

Number negative(Number number) {
  number.mantissa = -number.mantissa;
  return number;
}

bool is_less(const Number& a, const Number& b) {
  return sum(a, negative(b)).mantissa < 0;
}

std::optional<Number> quotient(const Number& a, const Number& b) {
  if (b.mantissa == 0) return std::nullopt;
  if (a.mantissa % b.mantissa == 0) {
    return io::normalised(Integer(a.mantissa / b.mantissa), a.two - b.two,
                          a.five - b.five);
  }
  const double value = io::to_double(a) / io::to_double(b);
  if (!std::isfinite(value)) return std::nullopt;
  return io::number_of(value);
}

Number sine(const Number& degrees) {
  // The remainder is exact, and so are the comparisons.
  const double turn = std::remainder(io::to_double(degrees), 360.0);
  const double size = std::abs(turn);
  const double folded = size > 90 ? 180 - size : size;
  double value = std::sin(folded * std::numbers::pi / 180);
  if (folded == 0) value = 0;
  if (folded == 30) value = 0.5;
  if (folded == 90) value = 1;
  return io::number_of(turn < 0 ? -value : value);
}

Number cosine(const Number& degrees) {
  const double turn = std::remainder(io::to_double(degrees), 360.0);
  return sine(io::number_of(90 - std::abs(turn)));
}

std::optional<Number> square_root(const Number& number) {
  const double value = io::to_double(number);
  if (number.mantissa < 0 || !std::isfinite(value)) return std::nullopt;
  return io::number_of(std::sqrt(value));
}

Number floor_of(const Number& number) {
  if (number.two >= 0 && number.five >= 0) return number;
  // Over a common denominator.
  const auto power = [](int base, std::int32_t exponent) -> Integer {
    return pow(Integer(base), static_cast<unsigned>(exponent));
  };
  const Integer above = number.mantissa * power(2, std::max(number.two, 0)) *
                        power(5, std::max(number.five, 0));
  const Integer below =
      power(2, std::max(-number.two, 0)) * power(5, std::max(-number.five, 0));
  Integer whole = above / below;
  if (above < 0 && whole * below != above) whole -= 1;
  return io::normalised(std::move(whole), 0, 0);
}

std::optional<std::int64_t> whole_in(const Number& number, std::int64_t least,
                                     std::int64_t most) {
  const double value = io::to_double(number);
  if (floor_of(number) != number || value < static_cast<double>(least) ||
      value > static_cast<double>(most))
    return std::nullopt;
  return static_cast<std::int64_t>(value);
}

}  // namespace halfspace::csg
