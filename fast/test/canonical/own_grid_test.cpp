#include "canonical/own_grid.hpp"

#include <gtest/gtest.h>

#include <random>

namespace halfspace::fast {
namespace {

TEST(OwnGrid, FinenessIsThatOfADecimalOrOfNone) {
  const Unit hundredth = {10, -2}, eighth = {2, -3}, one = {10, 0};
  EXPECT_EQ(fineness_of(0, 7, hundredth), Fineness{});
  EXPECT_EQ(fineness_of(25, 1, hundredth), (Fineness{2, 0}));   // 1/4
  EXPECT_EQ(fineness_of(-30, 1, hundredth), (Fineness{1, 1}));  // -3/10
  EXPECT_EQ(fineness_of(40, 1, hundredth), (Fineness{0, 1}));   // 2/5
  EXPECT_EQ(fineness_of(-6, 1, eighth), (Fineness{2, 0}));      // -3/4
  EXPECT_EQ(fineness_of(8, 1, eighth), Fineness{});
  EXPECT_EQ(fineness_of(3, -40, one), (Fineness{3, 1}));  // -3/40
  EXPECT_EQ(fineness_of(21, 7, one), Fineness{});
  EXPECT_FALSE(fineness_of(1, 3, one));
  EXPECT_FALSE(fineness_of(22, 14, eighth));
  EXPECT_EQ(fineness_of(7, 1, {10, 3}), Fineness{});
}

TEST(OwnGrid, UnitsArePowersOfTwoWhereTheyCanBe) {
  EXPECT_EQ(unit_of({}), (Unit{10, 0}));
  EXPECT_EQ(unit_of({3, 0}), (Unit{2, -3}));
  EXPECT_EQ(unit_of({0, 2}), (Unit{10, -2}));
  EXPECT_EQ(unit_of({5, 2}), (Unit{10, -5}));
}

/// A number of steps that is whole in the unit that it needs, and in none that
/// is coarser.
TEST(OwnGrid, NumbersAreWholeInTheUnitThatTheyNeed) {
  std::mt19937 random(5);
  for (int k = 0; k < 400; ++k) {
    const Unit from = {k % 2 == 0 ? 2 : 10, -static_cast<int>(random() % 12)};
    const BigInteger steps = static_cast<int>(random() % 40000) - 20000;
    if (steps == 0) continue;
    const Unit own = unit_of(*fineness_of(steps, 1, from));
    EXPECT_TRUE(StepRatio(from, own)(steps));
    if (own.exponent == 0) continue;
    EXPECT_FALSE(StepRatio(from, {own.base, own.exponent + 1})(steps));
    if (own.base == 10) {
      EXPECT_FALSE(StepRatio(from, {2, -200})(steps));
    }
  }
}

TEST(OwnGrid, PointsGoToOtherUnitsAndBack) {
  const StepRatio finer({2, -1}, {10, -2}), coarser({10, -2}, {2, -1});
  EXPECT_FALSE(finer.is_whole());
  EXPECT_TRUE(coarser.is_whole());
  EXPECT_TRUE(StepRatio({10, -2}, {10, -1}).is_whole());
  EXPECT_TRUE(StepRatio({2, 0}, {10, 0}).is_one());
  EXPECT_EQ(finer(GridPoint{1, -3, 0}), (GridPoint{50, -150, 0}));
  EXPECT_EQ(coarser(GridPoint{50, -150, 0}), (GridPoint{1, -3, 0}));
  EXPECT_FALSE(coarser(GridPoint{50, -151, 0}));
  EXPECT_FALSE(finer(GridPoint{std::int64_t{1} << 50, 0, 0}));
  EXPECT_EQ(finer.value(), 50);
  EXPECT_EQ(finer(std::array<BigInteger, 4>{1, 2, 3, 5}),
            (GridPoint{10, 20, 30}));
  EXPECT_FALSE(finer(std::array<BigInteger, 4>{1, 2, 3, 7}));
}

/// Planes that meet in a point of the grid, and in one that is on none.
TEST(OwnGrid, VerticesAreExact) {
  GeometryTable table(26);
  const std::int32_t x = table.add_plane({2, 0, 0}, {3, 1, 1}).plane;
  const std::int32_t y = table.add_plane({0, 3, 0}, {5, 2, 0}).plane;
  const std::int32_t slanted = table.add_plane({2, 2, 2}, {1, 0, 7}).plane;
  EXPECT_EQ(offset_of(table, x), 3);
  EXPECT_EQ(offset_of(table, slanted), 8);
  const auto grid = exact_vertex(table, table.meet(x, y, slanted));
  EXPECT_EQ(grid, (std::array<BigInteger, 4>{3, 2, 3, 1}));
  const std::int32_t p = table.add_plane({2, 3, 0}, {0, 1, 0}).plane;
  const std::int32_t q = table.add_plane({2, -3, 0}, {1, 1, 0}).plane;
  const std::int32_t r = table.add_plane({0, 0, 1}, {0, 0, -4}).plane;
  const auto v = exact_vertex(table, table.meet(p, q, r));
  EXPECT_GT(v[3], 0);
  // 2 x + 3 y = 3 and 2 x - 3 y = -1.
  EXPECT_EQ(2 * v[0], v[3]);
  EXPECT_EQ(3 * v[1], 2 * v[3]);
  EXPECT_EQ(v[2], -4 * v[3]);
}

}  // namespace
}  // namespace halfspace::fast
