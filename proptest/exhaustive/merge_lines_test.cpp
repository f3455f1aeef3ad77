#include "merge_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <thread>
#include <vector>

#include "adapters/screen_line.hpp"

namespace halfspace::exhaustive {
namespace {

/// The levels that this machine has; says which it has not.
std::vector<fast::SimdLevel> supported_levels() {
  std::vector<fast::SimdLevel> levels;
  for (const fast::SimdLevel level : kSimdLevels) {
    if (fast::is_supported(level)) {
      levels.push_back(level);
    } else {
      std::printf("skipped: this machine has no %s\n", level_name(level));
    }
  }
  return levels;
}

/// Merges the whole line, by as many threads as the machine has, at most four.
MergeTally merge_all(int width_px) {
  const std::uint32_t sets = 1u << width_px;
  const std::uint32_t shares =
      std::min(4u, std::max(1u, std::thread::hardware_concurrency()));
  const std::vector<fast::SimdLevel> levels = supported_levels();
  std::vector<MergeTally> tallies(shares);
  std::vector<std::thread> threads;
  for (std::uint32_t k = 0; k < shares; ++k) {
    threads.emplace_back([&, k] {
      tallies[k] = merge_lines(width_px, sets * k / shares,
                               sets * (k + 1) / shares, levels);
    });
  }
  MergeTally all;
  for (std::uint32_t k = 0; k < shares; ++k) {
    threads[k].join();
    all.add(tallies[k]);
  }
  return all;
}

TEST(Exhaustive, MergesAreTheSameOnEveryLineOf12Pixels) {
  const MergeTally all = merge_all(12);
  EXPECT_EQ(all.mismatches, 0u) << all.first_mismatch;
  EXPECT_EQ(all.pairs, std::uint64_t{1} << 24);
  for (int k = 1; k <= 8; ++k) {
    EXPECT_GT(all.steps_of_case[k], all.steps / 50) << "case " << k;
    RecordProperty("case_" + std::to_string(k),
                   std::to_string(all.steps_of_case[k]));
  }
  // Mirror images: what precedes from one end follows from the other.
  EXPECT_EQ(all.steps_of_case[2], all.steps_of_case[6]);
  EXPECT_EQ(all.steps_of_case[3], all.steps_of_case[7]);
}

TEST(Exhaustive, RandomMergesOfLongLinesAreTheSameByEveryLevel) {
  for (const fast::SimdLevel level : supported_levels()) {
    const MergeTally tally = merge_random(1'000'000, 1, level);
    EXPECT_EQ(tally.mismatches, 0u) << tally.first_mismatch;
    EXPECT_GE(tally.pairs, 1'000'000u);
  }
}

TEST(Exhaustive, AMergeTallyNamesThePairThatDiffers) {
  MergeTally right = merge_lines(4, 0, 16, kSimdLevels);
  EXPECT_EQ(right.mismatches, 0u);
  MergeTally wrong;
  wrong.mismatches = 1;
  wrong.first_mismatch = "this one";
  right.add(wrong);
  EXPECT_EQ(right.mismatches, 1u);
  EXPECT_EQ(right.first_mismatch, "this one");
}

}  // namespace
}  // namespace halfspace::exhaustive
