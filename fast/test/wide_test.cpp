#include "wide.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <random>

namespace halfspace::fast {
namespace {

using boost::multiprecision::cpp_int;

template <std::size_t kWords>
cpp_int to_big(const Wide<kWords>& a) {
  cpp_int value = 0;
  for (std::size_t i = kWords; i-- > 0;) value = (value << 64) + a.words[i];
  if (a.is_negative()) value -= cpp_int(1) << (64 * kWords);
  return value;
}

/// Random words, extreme ones often: carries must run through.
template <std::size_t kWords>
Wide<kWords> random_wide(std::mt19937_64& random, std::size_t words_used) {
  Wide<kWords> value;
  const std::uint64_t extremes[] = {0, 1, ~std::uint64_t{0},
                                    std::uint64_t{1} << 63,
                                    (std::uint64_t{1} << 63) - 1};
  for (std::size_t i = 0; i < words_used; ++i) {
    value.words[i] = random() % 2 == 0 ? random() : extremes[random() % 5];
  }
  // Room for a sum of two, so that nothing overflows.
  value.words[words_used - 1] >>= 2;
  if (random() % 2 == 0) return -value;
  return value;
}

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

}  // namespace
}  // namespace halfspace::fast
