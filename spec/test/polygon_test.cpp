#include "halfspace/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace halfspace {
namespace {

TEST(EdgeNames, AreRotatedSoThatTheLeastComesFirstWhereverTheyBegin) {
  using enum EdgeName::Kind;
  const std::vector<EdgeName> least_first = {
      {kSource, 1}, {kSplitter, 0}, {kSource, 7}, {kSource, 3}};
  std::vector<EdgeName> edges = least_first;
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(rotated_to_least(edges), least_first);
    std::rotate(edges.begin(), edges.begin() + 1, edges.end());
  }
  EXPECT_TRUE(rotated_to_least({}).empty());
}

}  // namespace
}  // namespace halfspace
