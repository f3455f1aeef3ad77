#include "halfspace/csg/scaled.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace halfspace::csg {
namespace {

TEST(Scaled, DoublesAreWrittenAsTheyAre) {
  EXPECT_EQ(to_string({24, {10, 0}, 3}, 12), "24");
  EXPECT_EQ(to_string({0, {10, 4096}, 3}, 12), "0");
  EXPECT_EQ(to_string({8, {10, -100}, 3}, 12), "8e-300");
  EXPECT_EQ(to_string({-1, {2, -1}, 2}, 9), "-0.25");
  // The power of the unit alone is no double.
  EXPECT_EQ(to_string({0x1p60, {2, -1060}, 1}, 12), "9.33263618503e-302");
}

TEST(Scaled, NumbersThatNoDoubleIsNearAreWritten) {
  EXPECT_FALSE((Scaled{8, {10, 300}, 3}.is_double()));
  EXPECT_EQ(to_string({8, {10, 300}, 3}, 12), "8e+900");
  EXPECT_EQ(to_string({-8, {10, -300}, 3}, 12), "-8e-900");
  EXPECT_EQ(to_string({1.0 / 3, {10, 4096}, 3}, 12), "3.33333333333e+12287");
  EXPECT_EQ(to_string({1.5, {10, -4096}, 3}, 12), "1.5e-12288");
  // 2^3072 = 5.8096059953...e924.
  EXPECT_EQ(to_string({1, {2, 1024}, 3}, 9), "5.809606e+924");
  // A double below the normal ones has few digits of its own.
  EXPECT_EQ(to_string({1, {2, -1074}, 1}, 9), "4.94065646e-324");
  EXPECT_EQ(to_string({3, {10, -320}, 1}, 9), "3e-320");
}

TEST(Scaled, RoundingMayTakeADigitMore) {
  EXPECT_EQ(to_string({999.9996, {10, 400}, 1}, 6), "1e+403");
  EXPECT_EQ(to_string({999.9994, {10, 400}, 1}, 6), "9.99999e+402");
  EXPECT_EQ(to_string({999999, {10, -500}, 1}, 6), "9.99999e-495");
}

/// Against doubles: the same digits, and 500 powers of ten on.
TEST(Scaled, DigitsAreThoseOfDoubles) {
  double value = 1;
  for (int i = 0; i < 500; ++i) {
    value = std::fmod(value * 1.2345678901 + 0.37, 1000);
    if (value < 1) value += 1;
    const std::string near = to_string({value, {10, 0}, 1}, 7);
    const std::string far = to_string({value, {10, 500}, 1}, 7);
    const std::size_t e = far.find('e');
    ASSERT_NE(e, std::string::npos) << far;
    const double there = std::stod(far.substr(0, e)) *
                         std::pow(10.0, std::stoi(far.substr(e + 1)) - 500);
    EXPECT_NEAR(std::stod(near), there, 1e-6) << near << " " << far;
  }
}

}  // namespace
}  // namespace halfspace::csg
