#include "halfspace/int128.hpp"

#include <gtest/gtest.h>

#include <string>

namespace halfspace {
namespace {

constexpr Int128 kMost = ~(Int128{1} << 127);
const std::string kMostText = "170141183460469231731687303715884105727";
const std::string kLeastText = "-170141183460469231731687303715884105728";

TEST(Int128Text, IsDecimalAtBothEnds) {
  EXPECT_EQ(to_string(kMost), kMostText);
  EXPECT_EQ(to_string(-kMost - 1), kLeastText);
  EXPECT_EQ(to_string(0), "0");
  EXPECT_EQ(to_string(-10), "-10");
  EXPECT_EQ(to_string(907), "907");
}

TEST(Int128Text, IsReadUpTo127Bits) {
  const auto read = [](const std::string& text) {
    Int128 value = 12345;
    return parse_int128(text, value) ? to_string(value) : "refused";
  };
  EXPECT_EQ(read(kMostText), kMostText);
  EXPECT_EQ(read("-" + kMostText), "-" + kMostText);
  EXPECT_EQ(read("+" + kMostText), kMostText);
  EXPECT_EQ(read("0" + kMostText), kMostText);
  // One more in the last place, and ten times as much.
  EXPECT_EQ(read("170141183460469231731687303715884105728"), "refused");
  EXPECT_EQ(read(kLeastText), "refused");
  EXPECT_EQ(read("1701411834604692317316873037158841057270"), "refused");
  EXPECT_EQ(read("0"), "0");
  EXPECT_EQ(read("-0"), "0");
  EXPECT_EQ(read("+9"), "9");
  EXPECT_EQ(read("-1234567890"), "-1234567890");
  for (const char* text : {"", "-", "+", "--1", "+-1", "1-", "1 ", " 1", "/",
                           ":", "1:", "0x1", "1.0", "1e3"}) {
    EXPECT_EQ(read(text), "refused") << text;
  }
}

}  // namespace
}  // namespace halfspace
