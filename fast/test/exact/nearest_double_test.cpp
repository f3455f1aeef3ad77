#include "exact/nearest_double.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "exact/wide_draws.hpp"

namespace halfspace::fast {
namespace {

TEST(NearestDouble, QuotientsAreTheNearestDoubles) {
  std::mt19937_64 random(7);
  int quick = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto [n, d] = random_quotient(random, 10);
    bool rounded = false, exactly = false;
    const double found = quotient(n, d, rounded);
    ASSERT_EQ(found, exact_quotient(n, d, exactly));
    ASSERT_EQ(rounded, exactly);
    quick += quick_quotient(n, d) != 0 ? 1 : 0;
    // Twice the distance is at most the step to the next double. Times 2^200,
    // so that all of it is whole.
    const cpp_int over = to_big(n) << 200;
    const cpp_int off = abs(cpp_int(std::ldexp(found, 200)) * to_big(d) - over);
    ASSERT_EQ(rounded, off != 0);
    const double step =
        std::nextafter(std::abs(found), HUGE_VAL) - std::abs(found);
    ASSERT_LE(2 * off, cpp_int(std::ldexp(step, 200)) * to_big(d));
  }
  EXPECT_GT(quick, 2000);
}

}  // namespace
}  // namespace halfspace::fast
