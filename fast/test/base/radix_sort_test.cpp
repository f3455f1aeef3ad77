#include "base/radix_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "halfspace/fast/list.hpp"

namespace halfspace::fast {
namespace {

TEST(RadixSort, SortByKeyIsStable) {
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
