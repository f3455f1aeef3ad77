#include "halfspace/result.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace halfspace {
namespace {

using Numbers = Result<std::vector<int>>;

Numbers one_to_three() { return std::vector<int>{1, 2, 3}; }

// A reference to what is in a Result that is gone would compile, too.
static_assert(std::is_same_v<decltype(*one_to_three()), std::vector<int>>);
static_assert(
    std::is_same_v<decltype(one_to_three().value()), std::vector<int>>);
static_assert(
    std::is_same_v<decltype(*std::declval<Numbers&>()), std::vector<int>&>);

TEST(Result, ALoopMayGoOverAValueThatNobodyKeeps) {
  int sum = 0;
  for (const int& number : *one_to_three()) sum += number;
  EXPECT_EQ(sum, 6);
  const std::vector<int>& kept = *one_to_three();
  EXPECT_EQ(kept.back(), 3);
}

TEST(Result, AValueThatCannotBeCopiedIsMovedOut) {
  Result<std::unique_ptr<int>> made = std::make_unique<int>(7);
  const std::unique_ptr<int> taken = *std::move(made);
  EXPECT_EQ(*taken, 7);
}

}  // namespace
}  // namespace halfspace
