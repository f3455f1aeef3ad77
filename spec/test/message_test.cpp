#include "halfspace/message.hpp"

#include <gtest/gtest.h>

#include <string>

namespace halfspace {
namespace {

TEST(InQuotes, TokensAreShortAndPrintable) {
  EXPECT_EQ(in_quotes(""), "''");
  EXPECT_EQ(in_quotes(" ~a\x1f\x7f\xff\n"), "' ~a" + std::string(4, '?') + "'");
  const std::string forty(40, 'x');
  EXPECT_EQ(in_quotes(forty), "'" + forty + "'");
  EXPECT_EQ(in_quotes(forty + "y"), "'" + forty + "...'");
}

}  // namespace
}  // namespace halfspace
