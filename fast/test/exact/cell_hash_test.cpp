#include "exact/cell_hash.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "exact/nearest_double.hpp"
#include "exact/wide_draws.hpp"

namespace halfspace::fast {
namespace {

TEST(CellHash, CellsAreThoseOfTheExactQuotients) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 20000; ++i) {
    const auto [n, d] = random_quotient(random, 16);
    const int digits = cell_digits(i % 2 == 0 ? 26 : 54);
    bool rounded = false;
    if (std::abs(quotient(n, d, rounded)) > 0x1p48) continue;
    const double error = std::abs(quotient(n, d, rounded)) * 0x1p-50;
    const double off = static_cast<double>(random() % 3) - 1;
    const double approximate = quotient(n, d, rounded) + off * error / 2;
    // The floor of the quotient in cells and one half.
    const cpp_int unit = to_big(d) << std::max(0, -digits);
    const cpp_int over = (to_big(n) << (std::max(0, digits) + 1)) + unit;
    const cpp_int by = 2 * unit;
    cpp_int cell = over / by;
    if (cell * by > over) --cell;
    ASSERT_EQ(cell_of<5>(approximate, error, n, d, digits), cell);
    ASSERT_EQ(exact_cell<5>(approximate, n, d, digits), cell);
  }
}

TEST(CellHash, PointsOfTheGridHaveTheCellsOfTheirQuotients) {
  std::mt19937_64 random(9);
  for (const int grid_bits : {26, 40, 54}) {
    const int digits = cell_digits(grid_bits);
    for (int i = 0; i < 3000; ++i) {
      const auto limit = std::int64_t{1} << (i % (grid_bits - 1));
      std::int64_t at = static_cast<std::int64_t>(random()) % limit;
      // Right at the borders of cells, and one below.
      if (i % 2 == 0) at = at / 256 * 256 + 128 - i / 2 % 2;
      const auto d = static_cast<std::int64_t>(1 + random() % 1000);
      const Wide<4> n = Wide<4>(Int128{at} * d);
      const double near = static_cast<double>(at);
      ASSERT_EQ(cell_of(at, digits),
                exact_cell<5>(near, n, Wide<4>(Int128{d}), digits));
      ASSERT_EQ(cell_of(at, digits), cell_of<5>(near, std::abs(near) * 0x1p-50,
                                                n, Wide<4>(Int128{d}), digits));
    }
  }
}

}  // namespace
}  // namespace halfspace::fast
