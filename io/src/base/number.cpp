#include "halfspace/io/number.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace halfspace::io {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

Error number_error(ErrorCode code, std::string_view text, const char* what) {
  return {code, in_quotes(text) + " " + what};
}

/// Whether `text` is one of the ways to write what is no number, or infinite.
bool names_no_number(std::string_view text) {
  std::string lower;
  for (const char c : text.substr(0, 16)) {
    lower.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a')
                                         : c);
  }
  if (!lower.empty() && (lower[0] == '-' || lower[0] == '+')) lower.erase(0, 1);
  return lower.starts_with("nan") || lower.starts_with("inf") ||
         lower.starts_with("1.#");
}

/// The places of a decimal: its digits without the zeros at either end, times
/// ten to the exponent.
struct Decimal {
  bool negative = false;
  std::string digits;
  std::int64_t exponent = 0;
};

/// Takes the digits at the front of `rest`; says whether there were any.
bool take_digits(std::string_view& rest, std::string& digits) {
  const auto end = std::find_if_not(rest.begin(), rest.end(), is_digit);
  const auto count = static_cast<std::size_t>(end - rest.begin());
  digits += rest.substr(0, count);
  rest.remove_prefix(count);
  return count > 0;
}

/// Takes the exponent that is all of `rest`. Beyond the limit all are one.
bool take_exponent(std::string_view rest, std::int64_t& exponent) {
  constexpr std::int64_t kLimit = std::int64_t{1} << 40;
  const bool negative = !rest.empty() && rest[0] == '-';
  if (!rest.empty() && (rest[0] == '-' || rest[0] == '+')) {
    rest.remove_prefix(1);
  }
  if (rest.empty() || !std::all_of(rest.begin(), rest.end(), is_digit)) {
    return false;
  }
  std::int64_t size = 0;
  for (const char c : rest) size = std::min(10 * size + (c - '0'), kLimit);
  exponent = negative ? -size : size;
  return true;
}

bool take_decimal(std::string_view text, Decimal& decimal) {
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) {
    decimal.negative = text[0] == '-';
    text.remove_prefix(1);
  }
  bool any = take_digits(text, decimal.digits);
  if (!text.empty() && text[0] == '.') {
    text.remove_prefix(1);
    const std::size_t before = decimal.digits.size();
    any = take_digits(text, decimal.digits) || any;
    decimal.exponent -=
        static_cast<std::int64_t>(decimal.digits.size() - before);
  }
  if (!any) return false;
  if (!text.empty()) {
    std::int64_t exponent = 0;
    if ((text[0] != 'e' && text[0] != 'E') ||
        !take_exponent(text.substr(1), exponent)) {
      return false;
    }
    decimal.exponent += exponent;
  }
  std::string& digits = decimal.digits;
  digits.erase(0, digits.find_first_not_of('0'));
  const std::size_t kept = digits.find_last_not_of('0') + 1;
  decimal.exponent += static_cast<std::int64_t>(digits.size() - kept);
  digits.resize(kept);
  return true;
}

std::int64_t small_integer(std::string_view digits) {
  std::int64_t value = 0;
  for (const char c : digits) value = 10 * value + (c - '0');
  return value;
}

/// The most decimal digits that an int64 holds whatever they are.
constexpr std::size_t kSmallDigits = 18;

/// The greatest double has 309 digits before its point.
constexpr std::int64_t kMostDigits = 309;

Integer long_integer(std::string_view digits, bool negative) {
  Integer value = 0;
  for (std::size_t i = 0; i < digits.size(); i += kSmallDigits) {
    const std::string_view chunk = digits.substr(i, kSmallDigits);
    std::int64_t scale = 1;
    for (std::size_t j = 0; j < chunk.size(); ++j) scale *= 10;
    value = value * scale + small_integer(chunk);
  }
  return negative ? Integer(-value) : value;
}

/// Normalises what fits 63 bits; most numbers do.
Number normalised_small(std::int64_t mantissa, std::int32_t two,
                        std::int32_t five) {
  if (mantissa == 0) return {};
  const int shift = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  mantissa >>= shift;  // exact
  two += shift;
  while (mantissa % 5 == 0) {
    mantissa /= 5;
    ++five;
  }
  return {mantissa, two, five};
}

bool is_small(const Integer& value) {
  return value >= -std::numeric_limits<std::int64_t>::max() &&
         value <= std::numeric_limits<std::int64_t>::max();
}

/// |value|, which is not zero, as a double times 2^exponent.
double leading_bits(Integer value, int& exponent) {
  const int length = static_cast<int>(msb(value)) + 1;
  exponent = std::max(0, length - 64);
  value >>= exponent;
  return static_cast<double>(static_cast<std::uint64_t>(value));
}

}  // namespace

Number normalised(Integer mantissa, std::int32_t two, std::int32_t five) {
  if (is_small(mantissa)) {
    return normalised_small(static_cast<std::int64_t>(mantissa), two, five);
  }
  const auto shift = static_cast<std::int32_t>(
      lsb(mantissa < 0 ? Integer(-mantissa) : mantissa));
  mantissa >>= shift;  // exact, so it does not matter which way it rounds
  two += shift;
  // 5^27 is the greatest power of 5 in 63 bits.
  constexpr std::int64_t kFiveTo27 = 7450580596923828125;
  while (mantissa % kFiveTo27 == 0) {
    mantissa /= kFiveTo27;
    five += 27;
  }
  while (mantissa % 5 == 0) {
    mantissa /= 5;
    ++five;
  }
  return {std::move(mantissa), two, five};
}

Result<Number> parse_number(std::string_view text) {
  Decimal decimal;
  if (!take_decimal(text, decimal)) {
    if (names_no_number(text)) {
      return number_error(ErrorCode::kNotFinite, text, "is not finite");
    }
    return number_error(ErrorCode::kSyntax, text, "is not a number");
  }
  const std::string_view digits = decimal.digits;
  if (digits.empty()) return Number{};
  const auto size = static_cast<std::int64_t>(digits.size());
  if (decimal.exponent < -kMaxDecimalPlaces) {
    return number_error(ErrorCode::kOutOfRange, text,
                        "has digits beyond 10^-1200");
  }
  const auto too_large = [&] {
    return number_error(ErrorCode::kOutOfRange, text,
                        "is beyond the greatest double, about 1.8 * 10^308");
  };
  if (decimal.exponent > kMostDigits - size) return too_large();
  const auto exponent = static_cast<std::int32_t>(decimal.exponent);
  Number number;
  if (digits.size() <= kSmallDigits) {
    const std::int64_t value = small_integer(digits);
    number =
        normalised_small(decimal.negative ? -value : value, exponent, exponent);
  } else {
    number =
        normalised(long_integer(digits, decimal.negative), exponent, exponent);
  }
  const bool may_be_too_large = exponent + size == kMostDigits;
  if (may_be_too_large && !std::isfinite(to_double(number))) return too_large();
  return number;
}

Number number_of(double value) {
  if (value == 0) return {};
  int exponent = 0;
  // 2^53 times a fraction below 1 is an integer: a double has 53 bits.
  const double fraction = std::frexp(value, &exponent);
  return normalised_small(static_cast<std::int64_t>(std::ldexp(fraction, 53)),
                          exponent - 53, 0);
}

double to_double(const Number& number) {
  if (number.mantissa == 0) return 0;
  const bool negative = number.mantissa < 0;
  Integer value = negative ? Integer(-number.mantissa) : number.mantissa;
  int shift = 0;
  if (number.five >= 0) {
    value *= pow(Integer(5), static_cast<unsigned>(number.five));
  } else {
    const Integer divisor =
        pow(Integer(5), static_cast<unsigned>(-number.five));
    // At least 64 bits of quotient.
    shift = std::max(
        0, static_cast<int>(msb(divisor)) - static_cast<int>(msb(value)) + 65);
    value = (value << shift) / divisor;
  }
  int exponent = 0;
  const double leading = leading_bits(std::move(value), exponent);
  const double size = std::ldexp(leading, exponent - shift + number.two);
  return negative ? -size : size;
}

}  // namespace halfspace::io
