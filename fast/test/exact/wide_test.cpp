#include "exact/wide.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <random>

#include "base/radix_sort.hpp"
#include "exact/cell_hash.hpp"
#include "exact/nearest_double.hpp"

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

/// n / d of which n has few bits more than d, often nearly or just a double
/// or halfway between two.
std::pair<Wide<4>, Wide<4>> random_quotient(std::mt19937_64& random,
                                            int dropped) {
  auto d = random_wide<4>(random, 1 + random() % 3);
  if (d.is_negative()) d = -d;
  if (sign(d) == 0) d = Wide<4>(1);
  const auto bits = static_cast<int>(random() % 54);
  auto n =
      multiply<4>(d, Int128{static_cast<std::int64_t>(random() >> dropped)});
  if (random() % 2 == 0) n = n + n + d;
  if (random() % 3 == 0) n = n + Wide<4>(static_cast<int>(random() % 3) - 1);
  if (random() % 3 == 0) n = n + random_wide<4>(random, 2);
  return {random() % 2 == 0 ? n : -n,
          multiply<4>(d, Int128{std::int64_t{1} << bits})};
}

TEST(Wide, QuotientsAreTheNearestDoubles) {
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

TEST(Wide, CellsAreThoseOfTheExactQuotients) {
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

TEST(Digits, SortByKeyIsStable) {
  std::mt19937_64 random(9);
  for (const std::size_t count : {0u, 1u, 200u, 3000u}) {
    List<KeyedIndex> keyed;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double value = std::ldexp(static_cast<double>(random() % 100) - 50,
                                      static_cast<int>(random() % 40) - 20);
      keyed.push_back({key_of(value), i});
    }
    auto expected = keyed;
    std::stable_sort(
        expected.begin(), expected.end(),
        [](const KeyedIndex& a, const KeyedIndex& b) { return a.key < b.key; });
    sort_by_key(keyed);
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_EQ(keyed[i].index, expected[i].index);
  }
  EXPECT_LT(key_of(-2.0), key_of(-1.0));
  EXPECT_LT(key_of(-1.0), key_of(0.0));
  EXPECT_LT(key_of(0.0), key_of(1e-30));
  EXPECT_LT(key_of(1.0), key_of(1e30));
}

}  // namespace
}  // namespace halfspace::fast
