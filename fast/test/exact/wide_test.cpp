#include "exact/wide.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

#include "drawing/short_product.hpp"
#include "exact/wide_draws.hpp"

namespace halfspace::fast {
namespace {

template <std::size_t kA, std::size_t kB, std::size_t kResult>
void check_products() {
  std::mt19937_64 random(kA * 100 + kB * 10 + kResult);
  for (int i = 0; i < 2000; ++i) {
    const auto a = random_wide<kA>(random, 1 + random() % kA);
    const auto b = random_wide<kB>(random, 1 + random() % kB);
    const cpp_int product = to_big(a) * to_big(b);
    // Only what fits is asked for.
    if (abs(product) >= (cpp_int(1) << (64 * kResult - 1))) continue;
    ASSERT_EQ(to_big(multiply<kResult>(a, b)), product);
    ASSERT_EQ(multiply_short<kResult>(a, b), multiply<kResult>(a, b));
    Wide<kResult> sum;
    add_product(a.words, b.words, sum.words);
    ASSERT_EQ(sum, multiply<kResult>(a, b));
  }
}

TEST(Wide, ProductsAreTrueWhereTheyFit) {
  check_products<2, 2, 4>();
  check_products<2, 2, 6>();
  check_products<3, 3, 8>();
  check_products<4, 2, 4>();
  check_products<6, 2, 6>();
  check_products<2, 6, 6>();
  check_products<8, 3, 8>();
  check_products<4, 4, 4>();
  check_products<7, 4, 10>();
  check_products<11, 11, 22>();
  check_products<7, 5, 11>();
}

TEST(Wide, ShortProductsOfTheLeastAndTheGreatestAreTrue) {
  const auto expect_true = [](std::int64_t a, std::int64_t b) {
    const Wide<6> x(a), y(b);
    EXPECT_EQ(to_big(multiply_short<9>(x, y)), cpp_int(a) * b);
    EXPECT_EQ(multiply_short<1>(x, y).words[0],
              multiply_short<9>(x, y).words[0]);
  };
  for (const std::int64_t a : {INT64_MIN, std::int64_t{-1}, std::int64_t{0},
                               std::int64_t{1}, INT64_MAX}) {
    for (const std::int64_t b : {INT64_MIN, std::int64_t{-1}, std::int64_t{0},
                                 std::int64_t{1}, INT64_MAX})
      expect_true(a, b);
  }
}

TEST(Wide, SumsDifferencesAndSignsAreTrue) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 5000; ++i) {
    const auto a = random_wide<6>(random, 1 + random() % 6);
    const auto b = i % 7 == 0 ? a : random_wide<6>(random, 1 + random() % 6);
    ASSERT_EQ(to_big(a + b), to_big(a) + to_big(b));
    ASSERT_EQ(to_big(a - b), to_big(a) - to_big(b));
    ASSERT_EQ(sign(a - b), (to_big(a) - to_big(b)).sign());
    ASSERT_EQ(to_big(Wide<8>(a)), to_big(a));
  }
}

TEST(Wide, DoublesAreOffByTheStatedBoundAtMost) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 5000; ++i) {
    const auto a = random_wide<8>(random, 1 + random() % 8);
    const cpp_int exact = to_big(a);
    // Times 2^64, so that what the double cuts off stays an integer.
    const cpp_int found(std::ldexp(to_double(a), 64));
    const cpp_int off = abs(found - (exact << 64));
    ASSERT_LE(off << 52, abs(exact) << 64);
  }
}

TEST(Wide, SmallValuesRoundTrip) {
  for (const std::int64_t value : {INT64_MIN, std::int64_t{-1}, std::int64_t{0},
                                   std::int64_t{1}, INT64_MAX}) {
    EXPECT_EQ(to_big(Wide<4>(value)), cpp_int(value));
    EXPECT_EQ(to_double(Wide<4>(value)), static_cast<double>(value));
  }
}

TEST(Wide, DoublesAreTheNearest) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 20000; ++i) {
    const Uint128 bits = Uint128{random()} << 64 | random();
    const Int128 value = static_cast<Int128>(bits) >> (random() % 128);
    ASSERT_EQ(to_double(value), static_cast<double>(value));
    ASSERT_EQ(to_double(-value), static_cast<double>(-value));
  }
}

// And those that a module for the web makes of halves, as it has no others.
TEST(Wide, ProductsOfFewWordsAreTheProducts) {
  std::mt19937_64 random(29);
  for (int round = 0; round < 20000; ++round) {
    const auto a = random_wide<4>(random, 1 + random() % 4);
    const auto b = random_wide<3>(random, 1 + random() % 3);
    ASSERT_EQ(to_big(multiply_short<8>(a, b)), to_big(a) * to_big(b)) << round;
    ASSERT_EQ(multiply_short<5>(a, b), multiply<5>(a, b)) << round;
    ASSERT_EQ(Wide<4>(a), multiply_short<4>(Wide<2>(1), a)) << round;
    const std::uint64_t x = a.words[0], y = b.words[0], add = a.words[1];
    std::uint64_t carry = b.words[1];
    const Uint128 expected = Uint128{x} * y + add + carry;
    const std::uint64_t low = multiply_words<true>(x, y, add, carry);
    ASSERT_EQ((Uint128{carry} << 64) | low, expected) << round;
  }
  for (const int bits : {0, 61, 62, 63, 64}) {
    const Int128 value = Int128{1} << bits;
    EXPECT_EQ(is_short(value), bits < 62) << bits;
    EXPECT_EQ(is_short(-value), bits < 62) << bits;
  }
}

}  // namespace
}  // namespace halfspace::fast
