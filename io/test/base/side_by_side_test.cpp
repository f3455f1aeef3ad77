#include "base/side_by_side.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace halfspace::io {
namespace {

TEST(SideBySide, DoesEachPieceOnceByAnyNumberOfThreads) {
  for (const int threads : {1, 2, 7}) {
    for (const std::size_t count : {0u, 1u, 5u, 1000u}) {
      std::vector<int> done(count);
      side_by_side(count, threads, [&](std::size_t i) { ++done[i]; });
      EXPECT_EQ(done, std::vector<int>(count, 1)) << threads;
    }
  }
}

TEST(SideBySide, ThrowsWhatAPieceThrew) {
  for (const int threads : {1, 2, 7}) {
    std::atomic<int> done = 0;
    const auto work = [&](std::size_t i) {
      if (i % 100 == 7) throw std::runtime_error("a piece");
      ++done;
    };
    EXPECT_THROW(side_by_side(1000, threads, work), std::runtime_error);
    EXPECT_LT(done, 1000 - 10);
  }
}

}  // namespace
}  // namespace halfspace::io
