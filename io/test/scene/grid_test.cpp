// The choice of a grid and coordinates on it, against fractions and a search
// through all units.

#include "scene/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace halfspace::io {
namespace {

using boost::multiprecision::cpp_rational;

cpp_rational power(int base, int exponent) {
  const Integer size =
      pow(Integer(base), static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? cpp_rational(1, size) : cpp_rational(size);
}

cpp_rational value_of(const Number& number) {
  return cpp_rational(number.mantissa) * power(2, number.two) *
         power(5, number.five);
}

/// The integer nearest to a fraction; halves go away from zero.
Integer rounded(const cpp_rational& value) {
  const Integer n = abs(numerator(value)), d = denominator(value);
  const Integer size = (2 * n + d) / (2 * d);
  return value < 0 ? Integer(-size) : size;
}

bool fits_in(const Integer& steps, int bits) {
  const Integer limit = Integer(1) << (bits - 1);
  return -limit <= steps && steps < limit;
}

/// A mesh whose vertices hold these numbers, and are all used.
Mesh mesh_of(const std::vector<Number>& numbers, bool decimal) {
  Mesh mesh;
  mesh.decimal = decimal;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    auto& vertex = mesh.vertices.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (i + axis < numbers.size()) vertex[axis] = numbers[i + axis];
    }
  }
  return mesh;
}

Result<GridChoice> chosen(const std::vector<Number>& numbers, bool decimal,
                          const ImportOptions& options = {}) {
  const Mesh mesh = mesh_of(numbers, decimal);
  return choose_grid(mesh, std::vector<bool>(mesh.vertices.size(), true),
                     options);
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int below(int limit) {
    return static_cast<int>(engine_() % static_cast<unsigned>(limit));
  }
  /// An integer of at most so many bits, often next to a power of two.
  Integer integer(int most_bits) {
    const int bits = 1 + below(most_bits);
    Integer value = 0;
    for (int i = 0; i < bits; ++i) value = 2 * value + below(2);
    if (below(3) == 0) value = (Integer(1) << bits) - below(3);
    return below(2) == 0 ? Integer(-value) : value;
  }

 private:
  std::mt19937 engine_;
};

TEST(ToGrid, IsTheNearestIntegerOfUnits) {
  Random random(1);
  int exact = 0, ties = 0, wide = 0;
  for (int i = 0; i < 6000; ++i) {
    const Integer mantissa = random.integer(80);
    const bool is_binary = random.below(3) != 0;
    const Number number =
        normalised(mantissa, random.below(80) - 60, random.below(70) - 35);
    Unit unit{is_binary ? 2 : 10, 0};
    unit.exponent =
        is_binary ? random.below(160) - 80 : std::min(number.two, number.five);
    if (is_binary && random.below(8) == 0) unit.exponent = number.two + 1;
    const cpp_rational in_units =
        value_of(number) / power(unit.base, unit.exponent);
    const Integer nearest = rounded(in_units);
    // As many bits as any grid has, and a few more.
    if (!fits_in(nearest, is_binary ? 62 : 63)) continue;
    const GridCoordinate coordinate = to_grid(number, unit);
    ASSERT_EQ(Integer(coordinate.steps), nearest) << i;
    const cpp_rational move =
        abs(in_units - cpp_rational(nearest)) * power(unit.base, unit.exponent);
    ASSERT_EQ(coordinate.moved, move != 0) << i;
    const double size = static_cast<double>(move);
    ASSERT_NEAR(coordinate.move, size, std::abs(size) * 0x1p-52) << i;
    exact += move == 0 ? 1 : 0;
    ties += denominator(in_units) == 2 ? 1 : 0;
    wide += !fits_in(nearest, 54) ? 1 : 0;
  }
  EXPECT_GT(exact, 300);
  EXPECT_GT(ties, 8);
  EXPECT_GT(wide, 60);
}

/// The greatest exponent up to `most` with which all numbers are multiples of
/// the base's power, if that is -60 or more.
std::optional<int> greatest_exponent(const std::vector<Number>& numbers,
                                     int base, int most) {
  for (int exponent = most; exponent >= -60; --exponent) {
    const bool all =
        std::all_of(numbers.begin(), numbers.end(), [&](const Number& number) {
          return denominator(cpp_rational(value_of(number) /
                                          power(base, exponent))) == 1;
        });
    if (all) return exponent;
  }
  return std::nullopt;
}

/// The grid that import_scene() promises where one is exact, found by a search.
std::optional<GridChoice> expected(const std::vector<Number>& numbers,
                                   bool decimal) {
  std::vector<Unit> units;
  for (const int base : {decimal ? 10 : 2, decimal ? 2 : 10}) {
    for (const int most : {0, 90}) {
      const auto exponent = greatest_exponent(numbers, base, most);
      if (exponent) units.push_back({base, *exponent});
    }
  }
  for (const int bits : kGridBits) {
    for (const Unit unit : units) {
      const bool all_fit = std::all_of(
          numbers.begin(), numbers.end(), [&](const Number& number) {
            return fits_in(
                rounded(value_of(number) / power(unit.base, unit.exponent)),
                bits);
          });
      if (all_fit) return GridChoice{unit, bits};
    }
  }
  return std::nullopt;
}

TEST(ChooseGrid, IsTheFirstOfAllUnitsThatIsExact) {
  Random random(2);
  int exact = 0, decimals = 0, large = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Number> numbers;
    const int two = random.below(50) - 30, five = random.below(45) - 35;
    for (int n = 1 + random.below(4); n > 0; --n) {
      const Integer mantissa = random.integer(56);
      numbers.push_back(
          mantissa == 0
              ? Number{}
              : normalised(mantissa, two + random.below(3),
                           random.below(2) == 0 ? random.below(3) : five));
    }
    if (std::all_of(numbers.begin(), numbers.end(),
                    [](const Number& n) { return n.mantissa == 0; })) {
      continue;
    }
    const bool decimal = random.below(2) == 0;
    const auto wanted = expected(numbers, decimal);
    const Result<GridChoice> choice = chosen(numbers, decimal);
    ASSERT_TRUE(choice);
    if (!wanted) {
      // Rounded: the least power of two that holds the greatest number.
      ASSERT_EQ(choice->bits, 54);
      ASSERT_EQ(choice->unit.base, 2);
      Integer most_of_finer = 0;
      for (const Number& number : numbers) {
        const int exponent = choice->unit.exponent;
        ASSERT_TRUE(fits_in(rounded(value_of(number) / power(2, exponent)), 54))
            << i;
        const cpp_rational size = abs(value_of(number));
        most_of_finer =
            std::max(most_of_finer, rounded(size / power(2, exponent - 1)));
      }
      ASSERT_GE(most_of_finer, Integer(1) << 53) << i;
      continue;
    }
    ASSERT_EQ(choice->bits, wanted->bits) << i;
    ASSERT_EQ(choice->unit, wanted->unit) << i;
    ++exact;
    decimals += wanted->unit.base == 10 ? 1 : 0;
    large += wanted->unit.exponent > 0 ? 1 : 0;
  }
  EXPECT_GT(exact, 25);
  EXPECT_LT(exact, 175);
  EXPECT_GT(decimals, 5);
  EXPECT_GT(large, 2);
}

Number number(const std::string& text) { return *parse_number(text); }

TEST(ChooseGrid, TakesTheNextUnitWhereRoundingCarriesToAPowerOfTwo) {
  // All ones, and thirds that make a fraction of it: 53 bits round up to 54.
  const std::vector<Number> numbers = {number("0.99999999999999999999999"),
                                       number("-0.33333333333333333333333")};
  const Result<GridChoice> choice = chosen(numbers, true);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->unit, (Unit{2, -52}));
  EXPECT_EQ(to_grid(numbers[0], choice->unit).steps, std::int64_t{1} << 52);
  const Result<GridChoice> less =
      chosen({number("0.99999999999999900000001"), numbers[1]}, true);
  ASSERT_TRUE(less);
  EXPECT_EQ(less->unit, (Unit{2, -53}));
}

TEST(ChooseGrid, RoundsWhatIsLessThanAPowerOfFive) {
  // 3 / 5^20 is 1.1 * 2^-45; in a unit of 10^-30 it has 55 bits and more.
  const Result<GridChoice> choice =
      chosen({normalised(3, 0, -20), normalised(1, 0, -30)}, true);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->unit, (Unit{2, -97}));
}

TEST(ChooseGrid, RefinesByWholePowersWithinTheBitsAskedFor) {
  ImportOptions options;
  // 5 has 4 bits with its sign: 4 more for each power of ten, 1 of two.
  const auto refined = [&](int bits, bool decimal) {
    options.refine_bits = bits;
    return *chosen({number("5")}, decimal, options);
  };
  for (const auto& [bits, exponent] : {std::pair(0, 0),
                                       {7, 0},
                                       {8, -1},
                                       {11, -1},
                                       {12, -2},
                                       {26, -5},
                                       {40, -5},
                                       {1000, -5}}) {
    EXPECT_EQ(refined(bits, true).unit, (Unit{10, exponent})) << bits;
    EXPECT_EQ(refined(bits, true).bits, 26);
  }
  for (const auto& [bits, exponent] :
       {std::pair(4, 0), {5, -1}, {26, -22}, {27, -22}}) {
    EXPECT_EQ(refined(bits, false).unit, (Unit{2, exponent})) << bits;
  }
}

TEST(ChooseGrid, StaysWithinUnitsOf4096) {
  const auto of_power = [](int two, int bits_of_mantissa,
                           const ImportOptions& options = {}) {
    return chosen(
        {normalised((Integer(1) << (bits_of_mantissa - 1)) + 1, two, 0)}, false,
        options);
  };
  ImportOptions fine;
  fine.refine_bits = 26;
  EXPECT_EQ(of_power(-4090, 3, fine)->unit, (Unit{2, -4096}));
  // With 60 bits: the exponent of the unit of 54 bits is 7 greater.
  EXPECT_EQ(of_power(4089, 60)->unit, (Unit{2, 4096}));
  EXPECT_EQ(of_power(-4103, 60)->unit, (Unit{2, -4096}));
  for (const int two : {4090, -4104}) {
    const Result<GridChoice> beyond = of_power(two, 60);
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().code, ErrorCode::kOutOfRange);
    EXPECT_EQ(beyond.error().message,
              "the coordinates need a unit of 2^" +
                  std::to_string(two > 0 ? 4097 : -4097) +
                  ", but units go from 2^-4096 to 2^4096");
  }
}

TEST(ChooseGrid, LooksAtWhatIsUsedOnly) {
  const Mesh mesh = mesh_of({number("0.25"), number("1"), number("1"),
                             number("0.3"), number("1e60"), number("1")},
                            true);
  EXPECT_EQ(choose_grid(mesh, {true, false}, {})->unit, (Unit{10, -2}));
  EXPECT_EQ(choose_grid(mesh, {false, false}, {})->unit, (Unit{10, 0}));
  ImportOptions options;
  options.grid_bits = 41;
  EXPECT_EQ(choose_grid(mesh, {true, false}, options).error().message,
            "a grid has 26, 40 or 54 bits, not 41");
}

}  // namespace
}  // namespace halfspace::io
