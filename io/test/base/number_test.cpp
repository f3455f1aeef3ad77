#include "halfspace/io/number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace halfspace::io {
namespace {

ErrorCode code_of(std::string_view text) {
  const Result<Number> number = parse_number(text);
  EXPECT_FALSE(number) << text;
  return number ? static_cast<ErrorCode>(-1) : number.error().code;
}

Number parsed(std::string_view text) {
  const Result<Number> number = parse_number(text);
  EXPECT_TRUE(number) << text;
  return number ? *number : Number{};
}

TEST(ParseNumber, ReadsDecimalsExactly) {
  // A tenth is 1 / (2 * 5), which no binary float is.
  EXPECT_EQ(parsed("0.1"), (Number{1, -1, -1}));
  EXPECT_NE(parsed("0.1"), number_of(0.1));
  EXPECT_EQ(parsed("1"), (Number{1, 0, 0}));
  EXPECT_EQ(parsed("-12"), (Number{-3, 2, 0}));
  EXPECT_EQ(parsed("1000"), (Number{1, 3, 3}));
  EXPECT_EQ(parsed("0.375"), (Number{3, -3, 0}));
}

TEST(ParseNumber, TakesEveryWayToWriteOneValueForTheSame) {
  for (const char* text : {"1.5", "+1.5", "1.50", "01.5", "15e-1", "15E-1",
                           ".15e1", "0.15e+01", "150000000000000000000000e-23",
                           "1.5e0", "0000000000000000000000000001.5"}) {
    EXPECT_EQ(parsed(text), (Number{3, -1, 0})) << text;
  }
  for (const char* text : {"0", "-0", "0.000", "0e99999999999999999999", "-.0",
                           "0.", "+0e-5000"}) {
    EXPECT_EQ(parsed(text), Number{}) << text;
  }
  EXPECT_EQ(parsed("2."), (Number{1, 1, 0}));
}

TEST(ParseNumber, KeepsHoweverManyDigits) {
  const std::string digits(1000, '3');
  const Number number = parsed("0." + digits);
  EXPECT_EQ(number.mantissa, Integer(digits));
  EXPECT_EQ(number.two, -1000);
  EXPECT_EQ(number.five, -1000);
  EXPECT_EQ(parsed("-0." + digits), (Number{-number.mantissa, -1000, -1000}));
  // The exact decimal of the double next to a tenth.
  EXPECT_EQ(parsed("0.1000000000000000055511151231257827021181583404541015625"),
            number_of(0.1));
}

TEST(ParseNumber, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"", "+", "-", ".", "e5", "1e", "1e+", "3.1+e2", "1..2", "1.2.3", "0x10",
        "1,5", "1 ", "--1", "1f", "1e5.5", "one"}) {
    EXPECT_EQ(code_of(text), ErrorCode::kSyntax) << text;
  }
  for (const char* text :
       {"nan", "NaN", "NAN", "-nan", "+nan", "inf", "+inf", "Infinity", "-INF",
        "1.#QNAN", "-1.#IND", "nan(ind)"}) {
    EXPECT_EQ(code_of(text), ErrorCode::kNotFinite) << text;
  }
}

TEST(ParseNumber, BoundsExponents) {
  EXPECT_TRUE(parse_number("1e308"));
  EXPECT_TRUE(parse_number("0001e308"));
  EXPECT_TRUE(parse_number("0.0001e312"));
  EXPECT_TRUE(parse_number("-1.7976931348623157e308"));
  EXPECT_TRUE(parse_number("1" + std::string(308, '0')));
  EXPECT_TRUE(parse_number("9e-1200"));
  EXPECT_TRUE(parse_number("0." + std::string(1199, '0') + "1"));
  EXPECT_EQ(code_of("1" + std::string(309, '0')), ErrorCode::kOutOfRange);
  for (const char* text :
       {"1e309", "-10e308", "1.8e308", "1.79769313486231581e308", "1e400",
        "1e-1201", "1e999999999999", "1e-99999999999999999999999999"}) {
    EXPECT_EQ(code_of(text), ErrorCode::kOutOfRange) << text;
  }
}

TEST(NumberOf, IsTheDouble) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(to_double(number_of(value)), value);
  }
  for (const double value :
       {0.0, 0.5, 1.0, 3.0, -1e300, 5e-324, std::numeric_limits<double>::max(),
        std::numeric_limits<double>::min()}) {
    EXPECT_EQ(to_double(number_of(value)), value);
  }
}

TEST(ToDouble, IsWithinAnUlp) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 5000; ++i) {
    const std::string text =
        std::to_string(random()) + std::to_string(random()) + "e" +
        std::to_string(static_cast<int>(random() % 400) - 220);
    const double got = to_double(parsed(text));
    const double want = std::stod(text);
    EXPECT_GE(got, std::nextafter(want, 0)) << text;
    EXPECT_LE(got, std::nextafter(want, 2 * want)) << text;
  }
  EXPECT_TRUE(std::isinf(to_double({1, 1000, 1000})));
  EXPECT_EQ(to_double(parsed("-1e-1000")), 0);
}

}  // namespace
}  // namespace halfspace::io
