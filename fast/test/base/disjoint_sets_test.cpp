#include "base/disjoint_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace halfspace::fast {
namespace {

TEST(DisjointSets, RootIsTheLeastElementOfTheSet) {
  constexpr std::int32_t kCount = 200;
  std::mt19937 random(5);
  DisjointSets sets(kCount);
  SparseDisjointSets sparse;
  // The definition: the least element of each element's set, by relabelling.
  std::vector<std::int32_t> least(kCount);
  std::iota(least.begin(), least.end(), 0);
  for (int step = 0; step < 150; ++step) {
    const auto i = static_cast<std::int32_t>(random() % kCount);
    const auto j = static_cast<std::int32_t>(random() % kCount);
    const auto [low, high] = std::minmax({least[static_cast<std::size_t>(i)],
                                          least[static_cast<std::size_t>(j)]});
    std::replace(least.begin(), least.end(), std::int32_t{high},
                 std::int32_t{low});
    ASSERT_EQ(sets.unite(i, j), low);
    ASSERT_EQ(sparse.unite(i, j), low);
    for (std::int32_t k = 0; k < kCount; ++k) {
      ASSERT_EQ(sets.root(k), least[static_cast<std::size_t>(k)]);
      ASSERT_EQ(sparse.root(k), least[static_cast<std::size_t>(k)]);
    }
  }
  sparse.parents().clear();
  for (std::int32_t k = 0; k < kCount; ++k) ASSERT_EQ(sparse.root(k), k);
}

TEST(DisjointSets, AttachedSetsHaveTheRootAbove) {
  DisjointSets sets(5);
  sets.unite(0, 1);
  sets.unite(2, 3);
  sets.attach(0, 2);
  for (const std::int32_t i : {0, 1, 2, 3}) EXPECT_EQ(sets.root(i), 2);
  EXPECT_EQ(sets.root(4), 4);
}

TEST(DisjointSets, SparseParentsAreKnownOnceSet) {
  SparseDisjointSets sets;
  EXPECT_EQ(sets.parents().get(7, -1), -1);
  sets.attach(7, 0);
  EXPECT_EQ(sets.parents().get(7, -1), 0);
  EXPECT_EQ(sets.root(7), 0);
  sets.parents().clear();
  EXPECT_EQ(sets.parents().get(7, -1), -1);
}

}  // namespace
}  // namespace halfspace::fast
