#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <string_view>

#include "halfspace/result.hpp"

namespace halfspace::io {

/// An integer of any size.
using Integer = boost::multiprecision::cpp_int;

/// An exact number as files hold them: mantissa * 2^two * 5^five.
///
/// The mantissa is divisible by neither 2 nor 5, and zero is 0 * 2^0 * 5^0, so
/// `==` compares values, a multiple of 10^k is told by `two >= k && five >= k`,
/// and one of 2^k by `two >= k && five >= 0`. A decimal that spells out a
/// binary float has that float's small mantissa.
struct Number {
  Integer mantissa = 0;
  std::int32_t two = 0;
  std::int32_t five = 0;
  friend bool operator==(const Number&, const Number&) = default;
};

/// No digit of a number in a text stands behind so many places after its point.
constexpr int kMaxDecimalPlaces = 1200;

/// The decimal number that `text` spells: sign, digits with or without a point,
/// exponent with `e` or `E`.
///
/// Exact:  yes, however many digits.
/// Errors: kNotFinite (nan, inf and their kin); kOutOfRange (a digit other than
///         a trailing zero beyond 10^-1200, or what is infinite in doubles);
///         kSyntax. The message names the text, not the place.
Result<Number> parse_number(std::string_view text);

/// The number that a double is.
/// Requires: value is finite.
/// Exact:    yes.
Number number_of(double value);

/// mantissa * 2^two * 5^five, normalised.
Number normalised(Integer mantissa, std::int32_t two, std::int32_t five);

/// The double next to the number, to within an ulp; infinite beyond doubles.
double to_double(const Number& number);

}  // namespace halfspace::io
