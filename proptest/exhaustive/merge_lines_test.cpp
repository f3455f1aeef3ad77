#include "merge_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace halfspace::exhaustive {
namespace {

/// Merges the whole line, by as many threads as the machine has, at most four.
MergeTally merge_all(int width_px) {
  const std::uint32_t sets = 1u << width_px;
  const std::uint32_t shares =
      std::min(4u, std::max(1u, std::thread::hardware_concurrency()));
  std::vector<MergeTally> tallies(shares);
  std::vector<std::thread> threads;
  for (std::uint32_t k = 0; k < shares; ++k) {
    threads.emplace_back([&, k] {
      tallies[k] =
          merge_lines(width_px, sets * k / shares, sets * (k + 1) / shares);
    });
  }
  MergeTally all;
  for (std::uint32_t k = 0; k < shares; ++k) {
    threads[k].join();
    all.add(tallies[k]);
  }
  return all;
}

TEST(Exhaustive, MergesAreTheSameOnEveryLineOf13Pixels) {
  const MergeTally all = merge_all(13);
  EXPECT_EQ(all.mismatches, 0u) << all.first_mismatch;
  EXPECT_EQ(all.pairs, std::uint64_t{1} << 26);
  for (int k = 1; k <= 8; ++k) {
    EXPECT_GT(all.steps_of_case[k], all.steps / 50) << "case " << k;
    RecordProperty("case_" + std::to_string(k),
                   std::to_string(all.steps_of_case[k]));
  }
  // Mirror images: what precedes from one end follows from the other.
  EXPECT_EQ(all.steps_of_case[2], all.steps_of_case[6]);
  EXPECT_EQ(all.steps_of_case[3], all.steps_of_case[7]);
}

TEST(Exhaustive, AMergeTallyNamesThePairThatDiffers) {
  MergeTally right = merge_lines(4, 0, 16);
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
