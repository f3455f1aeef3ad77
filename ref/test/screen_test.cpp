#include "halfspace/ref/screen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>

namespace halfspace::ref {
namespace {

constexpr int kWidth = 8;
constexpr unsigned kMasks = 1u << kWidth;

/// The maximal runs of ones of a mask whose bit i is pixel i.
std::vector<Span> runs_of(unsigned mask) {
  std::vector<Span> runs;
  for (std::int32_t i = 0; i < kWidth; ++i) {
    if ((mask >> i & 1) == 0) continue;
    if (!runs.empty() && runs.back().last == i - 1) {
      runs.back().last = i;
    } else {
      runs.push_back({i, i});
    }
  }
  return runs;
}

/// The ones of a mask, each a segment of its own.
std::vector<Span> pixels_of(unsigned mask) {
  std::vector<Span> pixels;
  for (std::int32_t i = 0; i < kWidth; ++i) {
    if ((mask >> i & 1) != 0) pixels.push_back({i, i});
  }
  return pixels;
}

/// The mask of the spans; nothing if they are not sorted, overlap, are empty
/// or leave the line.
std::optional<unsigned> mask_of(const std::vector<Span>& spans) {
  unsigned mask = 0;
  std::int32_t next = 0;
  for (const auto& [first, last] : spans) {
    if (first < next || last < first || last >= kWidth) return std::nullopt;
    for (std::int32_t i = first; i <= last; ++i) mask |= 1u << i;
    next = last + 1;
  }
  return mask;
}

/// All spans within a line.
std::vector<Span> all_spans() {
  std::vector<Span> spans;
  for (std::int32_t first = 0; first < kWidth; ++first) {
    for (std::int32_t last = first; last < kWidth; ++last) {
      spans.push_back({first, last});
    }
  }
  return spans;
}

/// A row of the table S4.7, in which I, J are the object's ends and Min, Max
/// the unlit segment's.
struct Row {
  bool holds = false;
  std::vector<Span> lit;
  std::vector<Span> unlit;
  bool next_object = false;
  std::ptrdiff_t unlit_passed = 0;  ///< segments left behind in the new list
};

std::vector<Row> rows_of(Span object, Span segment) {
  const auto [I, J] = object;
  const auto [Min, Max] = segment;
  return {
      {J < Min, {}, {{Min, Max}}, true, 0},
      {I <= Min && Min <= J && J < Max, {{Min, J}}, {{J + 1, Max}}, true, 0},
      {Min < I && J < Max, {{I, J}}, {{Min, I - 1}, {J + 1, Max}}, true, 1},
      {I <= Min && J == Max, {{Min, Max}}, {}, true, 0},
      {Min < I && I <= Max && J == Max, {{I, Max}}, {{Min, I - 1}}, true, 1},
      {I <= Min && J > Max, {{Min, Max}}, {}, false, 0},
      {Min < I && I <= Max && Max < J, {{I, Max}}, {{Min, I - 1}}, false, 1},
      {I > Max, {}, {{Min, Max}}, false, 1},
  };
}

TEST(RefScreen, ExactlyOneRowHoldsAndItIsTheCase) {
  for (const Span object : all_spans()) {
    for (const Span unlit : all_spans()) {
      const std::vector<Row> rows = rows_of(object, unlit);
      ASSERT_EQ(1, std::count_if(rows.begin(), rows.end(),
                                 [](const Row& row) { return row.holds; }));
      const auto number = static_cast<std::size_t>(merge_case(object, unlit));
      ASSERT_TRUE(1 <= number && number <= 8);
      EXPECT_TRUE(rows[number - 1].holds)
          << "case " << number << " for [" << object.first << ", "
          << object.last << "] against [" << unlit.first << ", " << unlit.last
          << "]";
    }
  }
}

TEST(RefScreen, MergeSegmentDoesWhatTheRowSays) {
  for (const Span object : all_spans()) {
    for (const Span segment : all_spans()) {
      const auto number = static_cast<std::size_t>(merge_case(object, segment));
      SCOPED_TRACE("case " + std::to_string(number));
      const Row row = rows_of(object, segment)[number - 1];
      const std::vector<Span> objects = {object};
      UnlitList list = {segment};
      auto next = objects.begin();
      auto unlit = list.begin();
      std::vector<Span> lit;
      merge_segment(next, list, unlit, [&](Span run) { lit.push_back(run); });
      EXPECT_EQ(row.lit, lit);
      EXPECT_EQ(row.unlit, std::vector<Span>(list.begin(), list.end()));
      EXPECT_EQ(row.next_object, next == objects.end());
      EXPECT_EQ(row.unlit_passed, std::distance(list.begin(), unlit));
    }
  }
}

TEST(RefScreen, MergeLightsTheIntersectionAndLeavesTheRestOnEveryLine) {
  for (unsigned objects = 0; objects < kMasks; ++objects) {
    for (unsigned unlit = 0; unlit < kMasks; ++unlit) {
      const Merged merged = merge(runs_of(objects), runs_of(unlit));
      ASSERT_EQ(objects & unlit, mask_of(merged.lit));
      ASSERT_EQ(unlit & ~objects, mask_of(merged.unlit));
      // No pixel of a run is cut off from its neighbours.
      ASSERT_EQ(runs_of(unlit & ~objects), merged.unlit);
    }
  }
}

TEST(RefScreen, MergeTakesSegmentsThatTouch) {
  for (unsigned objects = 0; objects < kMasks; ++objects) {
    for (unsigned unlit = 0; unlit < kMasks; ++unlit) {
      const Merged a = merge(pixels_of(objects), runs_of(unlit));
      ASSERT_EQ(objects & unlit, mask_of(a.lit));
      ASSERT_EQ(runs_of(unlit & ~objects), a.unlit);
      const Merged b = merge(runs_of(objects), pixels_of(unlit));
      ASSERT_EQ(objects & unlit, mask_of(b.lit));
      ASSERT_EQ(pixels_of(unlit & ~objects), b.unlit);
    }
  }
}

TEST(RefScreen, SplitKeepsTheRightPart) {  // E1
  const Merged merged = merge({{3, 4}}, {{0, 7}});
  EXPECT_EQ((std::vector<Span>{{3, 4}}), merged.lit);
  EXPECT_EQ((std::vector<Span>{{0, 2}, {5, 7}}), merged.unlit);
}

TEST(RefScreen, EveryPixelIsLitOnceAndTheScreenIsFullWhenAllAre) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    constexpr std::int32_t kLines = 3;
    DynamicScreen screen(kWidth, kLines);
    std::vector<unsigned> lit(kLines, 0);
    const auto all_lit = [&] {
      return std::all_of(lit.begin(), lit.end(),
                         [](unsigned mask) { return mask == kMasks - 1; });
    };
    while (!all_lit()) {
      ASSERT_FALSE(screen.full());
      const auto line = static_cast<std::int32_t>(random() % kLines);
      unsigned& mask = lit[static_cast<std::size_t>(line)];
      const unsigned objects = random() % kMasks;
      unsigned painted = 0;
      screen.merge(line, runs_of(objects), [&](Span run) {
        for (std::int32_t i = run.first; i <= run.last; ++i) {
          EXPECT_EQ(0u, painted >> i & 1);
          painted |= 1u << i;
        }
      });
      ASSERT_EQ(objects & ~mask, painted);
      mask |= painted;
    }
    ASSERT_TRUE(screen.full());
    screen.merge(0, {{0, kWidth - 1}}, [](Span) { FAIL() << "lit twice"; });
    ASSERT_TRUE(screen.full());
  }
}

}  // namespace
}  // namespace halfspace::ref
