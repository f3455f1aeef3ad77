#include "base/text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <random>
#include <string>

#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

using samples::expect_error;

TEST(Text, WordsDifferByLettersAlone) {
  EXPECT_TRUE(is_word("AZaz1@[`{", "azaz1@[`{"));
  EXPECT_TRUE(is_word("", ""));
  EXPECT_FALSE(is_word("a", "ab"));
  EXPECT_FALSE(is_word("ab", "a"));
  EXPECT_FALSE(is_word("b", "a"));
  EXPECT_FALSE(is_word("B", "a"));
  // What is as far from a letter as upper case from lower.
  EXPECT_FALSE(is_word("@", "`"));
  EXPECT_FALSE(is_word("[", "{"));
  EXPECT_FALSE(is_word("\x12", "2"));
}

/// The standard library's text of a number with digits after its point.
std::string standard_text(double value, int decimals) {
  std::array<char, 1500> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  return {text.data(), end};
}

TEST(Text, DigitsAfterThePointAreTheStandardLibrarys) {
  for (const double value :
       {0.0, -0.0, 0.5, 1.5, 2.5, -0.5, 0.125, 0.375, 9.5, 99.995, 0.9999, 1e22,
        -1e23, 0x1p53, 0x1p-1074, 0x1.fffffffffffffp1023, 640.0625, -1e-9}) {
    for (const int decimals : {0, 1, 2, 3, 17, 400, 1100})
      EXPECT_EQ(fixed_point(value, decimals), standard_text(value, decimals));
  }
  std::mt19937_64 random(7);
  int halves = 0;
  for (int k = 0; k < 20'000; ++k) {
    const std::uint64_t bits = random();
    // Any double; one of an image's size; one in the middle of two decimals.
    double value = std::bit_cast<double>(bits);
    if (k % 3 == 1) value = std::ldexp(static_cast<double>(bits >> 11), -43);
    if (k % 3 == 2) value = static_cast<double>(bits % 4000) / 16 - 100;
    if (!std::isfinite(value)) continue;
    const int decimals = static_cast<int>(random() % 12);
    halves += k % 3 == 2 && decimals < 4 ? 1 : 0;
    ASSERT_EQ(fixed_point(value, decimals), standard_text(value, decimals));
  }
  EXPECT_GT(halves, 1000);
}

TEST(Text, TellsWhatIsNoText) {
  const std::string why =
      "the text is in UTF-16 or UTF-32, which is not read; save it as UTF-8";
  for (const std::string& bytes :
       {std::string("\xff\xfe"), std::string("\xfe\xff"),
        std::string("\0\0\xfe\xff", 4)}) {
    const std::optional<Error> error = not_plain_text(bytes);
    ASSERT_TRUE(error);
    expect_error(Result<Done>(*error), ErrorCode::kUnknownFormat, why, 0);
  }
  const std::optional<Error> zero = not_plain_text({"ab\0c\0", 5});
  ASSERT_TRUE(zero);
  expect_error(Result<Done>(*zero), ErrorCode::kSyntax,
               "byte 2 is zero, so this is not text (perhaps UTF-16)", 2);
  EXPECT_FALSE(not_plain_text("a\xfe\xff"));
  EXPECT_FALSE(not_plain_text(""));
}

TEST(Text, IntegersAreReadWhole) {
  EXPECT_EQ(*parse_integer("9223372036854775807"), 9223372036854775807);
  EXPECT_EQ(*parse_integer("-12"), -12);
  EXPECT_EQ(*parse_integer("+12"), 12);
  EXPECT_EQ(*parse_integer("012"), 12);
  for (const char* token :
       {"", "+", "-", "+-1", "++1", "-+1", "1.", "0x1", "1 ", " 1", "1e3"}) {
    expect_error(parse_integer(token), ErrorCode::kSyntax,
                 std::string("'") + token + "' is not an integer");
  }
  for (const char* token : {"9223372036854775808", "-9223372036854775809"}) {
    expect_error(parse_integer(token), ErrorCode::kOutOfRange,
                 std::string("'") + token + "' is too large");
  }
}

/// The lines of a text: number, tokens, and whether it is cut.
std::string lines_of(std::string_view text, TextReader::Rules rules) {
  TextReader reader(text, rules);
  std::string all;
  while (reader.next_line()) {
    all += std::to_string(reader.line()) + ":";
    for (const std::string_view token : reader.left()) {
      all += "(" + std::string(token) + ")";
    }
    all += reader.is_cut() ? "cut" : ";";
  }
  return all + std::to_string(reader.line());
}

TEST(Text, IsCutIntoLinesAndTokens) {
  const TextReader::Rules plain;
  const TextReader::Rules comments{.comments = true, .continued = false};
  const TextReader::Rules continued{.comments = false, .continued = true};
  const TextReader::Rules both{.comments = true, .continued = true};
  EXPECT_EQ(lines_of("", plain), "1");
  EXPECT_EQ(lines_of("\xef\xbb\xbf"
                     "a b\n\n \t\v\f\r\nc",
                     plain),
            "1:(a)(b);4:(c)cut5");
  EXPECT_EQ(lines_of(" a\tb\r\n#c\n", plain), "1:(a)(b);2:(#c);3");
  EXPECT_EQ(lines_of("a#b\n#c\nd # e\n", comments), "1:(a);3:(d);4");
  EXPECT_EQ(lines_of("a \\\n b\nc\n", plain), "1:(a)(\\);2:(b);3:(c);4");
  EXPECT_EQ(lines_of("a\\\n b\\ \r\nc\nd\n", continued), "1:(a)(b)(c);4:(d);5");
  EXPECT_EQ(lines_of("a # \\\nb\n\\\n", both), "1:(a);2:(b);4");
  EXPECT_EQ(lines_of("\n\na\\", continued), "3:(a)cut4");
  EXPECT_EQ(lines_of("#\\\n \n", both), "3");
}

TEST(Text, TokensComeFromLineAfterLine) {
  TextReader reader("a b\n\nc d\ne\nrest\n", {});
  std::string_view token;
  EXPECT_FALSE(reader.at_end());
  ASSERT_TRUE(reader.next(token));
  EXPECT_EQ(token, "a");
  EXPECT_EQ(reader.left().size(), 1u);
  ASSERT_TRUE(reader.next(token));
  EXPECT_EQ(token, "b");
  ASSERT_TRUE(reader.next(token));
  EXPECT_EQ(token, "c");
  EXPECT_EQ(reader.line(), 3);
  reader.skip_line();
  EXPECT_TRUE(reader.left().empty());
  ASSERT_TRUE(reader.next(token));
  EXPECT_EQ(token, "e");
  EXPECT_EQ(reader.rest(), "rest\n");
  EXPECT_FALSE(reader.at_end());
  ASSERT_TRUE(reader.next(token));
  EXPECT_EQ(token, "rest");
  EXPECT_TRUE(reader.at_end());
  EXPECT_FALSE(reader.next(token));
}

TEST(Text, ErrorsNameTheLineAndWhetherItIsCut) {
  TextReader reader("a\nb", {});
  ASSERT_TRUE(reader.next_line());
  expect_error(Result<Done>(reader.error(ErrorCode::kSyntax, "why")),
               ErrorCode::kSyntax, "line 1: why", 1);
  ASSERT_TRUE(reader.next_line());
  expect_error(Result<Done>(reader.error(ErrorCode::kSyntax, "why")),
               ErrorCode::kTruncated, "line 2: why, and the file ends there",
               2);
  expect_error(Result<Done>(reader.error(ErrorCode::kBadIndex, "why")),
               ErrorCode::kBadIndex, "line 2: why", 2);
}

}  // namespace
}  // namespace halfspace::io
