#include "step_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace halfspace::csg {
namespace {

io::Number number(const char* text) {
  const Result<io::Number> value = io::parse_number(text);
  EXPECT_TRUE(value) << text;
  return value ? *value : io::Number{};
}

Numbers3 vector(const char* x, const char* y, const char* z) {
  return {number(x), number(y), number(z)};
}

TEST(Matrices, SumsAndProductsAreExact) {
  EXPECT_EQ(sum(number("0.1"), number("0.2")), number("0.3"));
  EXPECT_EQ(sum(number("1e300"), number("-1e300")), io::Number{});
  EXPECT_EQ(sum(number("1e200"), number("1e-200")),
            number(("1" + std::string(399, '0') + "1e-200").c_str()));
  EXPECT_EQ(product(number("-0.3"), number("1e9")), number("-3e8"));
}

TEST(Matrices, QuarterTurnsAreExact) {
  for (const char* degrees : {"90", "450", "-270", "9e1"}) {
    const Matrix turn = rotation(vector("0", "0", "7"), number(degrees));
    EXPECT_EQ(image_of(turn, vector("1", "2", "3")), vector("-2", "1", "3"));
  }
  const Matrix back = rotation(vector("0", "-1", "0"), number("90"));
  EXPECT_EQ(image_of(back, vector("1", "2", "3")), vector("-3", "2", "1"));
  EXPECT_EQ(rotation(vector("1", "0", "0"), number("360")), identity_matrix());
  EXPECT_EQ(rotation(vector("1", "1", "0"), number("0")), identity_matrix());
}

TEST(Matrices, OtherTurnsAreNearlyTurns) {
  const Matrix turn = rotation(vector("1", "1", "1"), number("120"));
  const Numbers3 at = image_of(turn, vector("1", "2", "3"));
  EXPECT_NEAR(io::to_double(at[0]), 3, 1e-14);
  EXPECT_NEAR(io::to_double(at[1]), 1, 1e-14);
  EXPECT_NEAR(io::to_double(at[2]), 2, 1e-14);
  EXPECT_EQ(determinant_sign(turn), 1);
  const Matrix huge =
      rotation(vector("1e300", "1e300", "1e300"), number("120"));
  EXPECT_EQ(huge, turn);
}

TEST(Matrices, MirrorsAndFlatteningAreTold) {
  EXPECT_EQ(determinant_sign(scaling(vector("1", "-1", "1"))), -1);
  EXPECT_EQ(determinant_sign(scaling(vector("1", "-1", "-1"))), 1);
  EXPECT_EQ(determinant_sign(scaling(vector("1", "0", "1"))), 0);
  const auto both = product(translation(vector("1", "2", "3")),
                            scaling(vector("2", "2", "2")));
  ASSERT_TRUE(both);
  EXPECT_EQ(image_of(*both, vector("1", "1", "1")), vector("3", "4", "5"));
}

TEST(StepMap, IntegersAndPowersOfTwoStayOnTheGrid) {
  const std::array<GridPoint, 2> points = {{{1, 2, 3}, {-4, 6, 10}}};
  const Unit unit{2, -1};
  const PlacedPoints half = placed(
      step_map(scaling(vector("0.5", "2", "-4")), unit), points, {2, -2});
  EXPECT_EQ(half.moved, 0u);
  EXPECT_EQ(half.points[0], (GridPoint{1, 8, -24}));
  EXPECT_EQ(half.points[1], (GridPoint{-4, 24, -80}));
}

TEST(StepMap, TheExtentSaysWhichUnitIsExact) {
  const std::array<GridPoint, 2> points = {{{10, 20, 40}, {-30, 0, 50}}};
  const Extent plain = extent_of(step_map(identity_matrix(), {10, -3}), points);
  EXPECT_EQ(plain.step, (io::Number{1, -2, -2}));
  EXPECT_EQ(plain.least, number("-0.03"));
  EXPECT_EQ(plain.greatest, number("0.05"));
  const Extent moved = extent_of(
      step_map(translation(vector("0.00025", "0", "0")), {10, -3}), points);
  // 0.01025 is 41 / 4000, and no other needs more of either prime.
  EXPECT_EQ(moved.step, (io::Number{1, -5, -3}));
  const Extent halved = extent_of(
      step_map(scaling(vector("0.25", "0.25", "0.25")), {2, 0}), points);
  EXPECT_EQ(halved.step.two, -1);
  EXPECT_GE(halved.step.five, 0);
}

TEST(StepMap, RoundingIsToTheNearestAndReported) {
  const std::array<GridPoint, 1> points = {{{3, -3, 5}}};
  // Quarters: 0.75 is nearer to 1, and 1.25 to 1.
  const StepMap map = step_map(scaling(vector("0.25", "0.25", "0.25")), {2, 0});
  const PlacedPoints rounded = placed(map, points, {2, 0});
  EXPECT_EQ(rounded.points[0], (GridPoint{1, -1, 1}));
  EXPECT_EQ(rounded.moved, 3u);
  EXPECT_EQ(rounded.max_move, 0.25);
  // Halves go away from zero; and so they do in numbers of any length.
  for (const char* tiny : {"0", "1e-1000"}) {
    const StepMap half =
        step_map(*product(translation(vector(tiny, "0", "0")),
                          scaling(vector("0.5", "0.5", "0.5"))),
                 {2, 0});
    const PlacedPoints at = placed(half, points, {2, 0});
    EXPECT_EQ(at.points[0], (GridPoint{2, -2, 3}));
    EXPECT_DOUBLE_EQ(at.max_move, 0.5);
  }
}

TEST(StepMap, NarrowAndWideIntegersAgree) {
  // A turn of so many digits that 128 bits hold neither it nor its images.
  const std::array<GridPoint, 2> points = {
      {{(1 << 25) - 1, -(1 << 25), 12345}, {-1, 0, 77}}};
  const Matrix turn = rotation(vector("1", "2", "3"), number("10"));
  const auto fine = product(translation(vector("1e-400", "0", "0")), turn);
  ASSERT_TRUE(fine);
  const PlacedPoints narrow = placed(step_map(turn, {2, 0}), points, {2, -20});
  const PlacedPoints wide = placed(step_map(*fine, {2, 0}), points, {2, -20});
  EXPECT_EQ(narrow.points, wide.points);
  EXPECT_DOUBLE_EQ(narrow.max_move, wide.max_move);
  EXPECT_LE(narrow.max_move, std::ldexp(0.5, -20));
}

}  // namespace
}  // namespace halfspace::csg
