#include "exact/cell_hash.hpp"

#include <gtest/gtest.h>

#include <cmath>
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
    const cpp_int over = (to_big(n) << (digits + 1)) + to_big(d);
    const cpp_int by = 2 * to_big(d);
    cpp_int cell = over / by;
    if (cell * by > over) --cell;
    ASSERT_EQ(cell_of<5>(approximate, error, n, d, digits), cell);
    ASSERT_EQ(exact_cell<5>(approximate, n, d, digits), cell);
  }
}

}  // namespace
}  // namespace halfspace::fast
