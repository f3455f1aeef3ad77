#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "halfspace/fast/screen.hpp"
#include "halfspace/image.hpp"

namespace halfspace::fast {
namespace {

constexpr std::array kLevels = {SimdLevel::kPortable, SimdLevel::kAvx2,
                                SimdLevel::kAvx512};
constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();

using Segments = std::vector<ObjectSegment>;

Segments lit_by(DynamicScreen& screen, const Segments& objects) {
  const auto lit = screen.light(objects);
  return {lit.begin(), lit.end()};
}

TEST(DynamicScreen, AMergeCallsBackWithLineSegmentAndId) {
  DynamicScreen screen(100, 3);
  std::vector<std::pair<ObjectSegment, PolygonId>> painted;
  const auto paint = [&](std::int32_t line, Span lit, PolygonId id) {
    painted.push_back({{line, lit}, id});
  };
  screen.merge(1, std::vector<Span>{{30, 40}, {60, 70}}, 5, paint);
  screen.merge(Segments{{0, {0, 9}}, {1, {20, 80}}}, 6, paint);
  const std::vector<std::pair<ObjectSegment, PolygonId>> expected = {
      {{1, {30, 40}}, 5}, {{1, {60, 70}}, 5}, {{0, {0, 9}}, 6},
      {{1, {20, 29}}, 6}, {{1, {41, 59}}, 6}, {{1, {71, 80}}, 6}};
  EXPECT_EQ(painted, expected);
  EXPECT_EQ(screen.unlit(0), (std::vector<Span>{{10, 99}}));
  EXPECT_EQ(screen.unlit(1), (std::vector<Span>{{0, 19}, {81, 99}}));
  EXPECT_EQ(screen.unlit(2), (std::vector<Span>{{0, 99}}));
}

TEST(DynamicScreen, WhatIsOffTheScreenIsNeverUnlit) {
  for (const SimdLevel level : kLevels) {
    DynamicScreen screen(40, 10, level);
    EXPECT_TRUE(lit_by(screen, {{-1, {0, 39}},
                                {10, {0, 39}},
                                {15, {0, 39}},
                                {kLeast, {0, 39}},
                                {kMost, {0, 39}},
                                {3, {40, kMost}},
                                {4, {kLeast, -1}},
                                {5, {7, 6}}})
                    .empty());
    EXPECT_TRUE(screen.unlit(-1).empty());
    EXPECT_TRUE(screen.unlit(10).empty());
    EXPECT_TRUE(screen.unlit(kMost).empty());
    EXPECT_EQ(lit_by(screen, {{9, {kLeast, kMost}}, {10, {0, 5}}}),
              (Segments{{9, {0, 39}}}));
    EXPECT_TRUE(screen.unlit(9).empty());
    EXPECT_EQ(screen.unlit(8), (std::vector<Span>{{0, 39}}));
  }
}

TEST(DynamicScreen, ItIsFullWhenTheLastPixelIsLitAndUnlitWhenCleared) {
  for (const SimdLevel level : kLevels) {
    DynamicScreen screen(33, 9, level);
    Segments all;
    for (std::int32_t j = 0; j < 9; ++j) all.push_back({j, {0, 32}});
    all.back().span.last = 31;
    screen.light(all);
    EXPECT_FALSE(screen.full());
    EXPECT_EQ(lit_by(screen, {{8, {0, 32}}}), (Segments{{8, {32, 32}}}));
    EXPECT_TRUE(screen.full());
    EXPECT_TRUE(screen.light(all).empty());
    screen.clear();
    EXPECT_FALSE(screen.full());
    EXPECT_EQ(lit_by(screen, all), all);
    DynamicScreen other = std::move(screen);
    EXPECT_EQ(other.unlit(8), (std::vector<Span>{{32, 32}}));
  }
}

TEST(DynamicScreen, ALevelThatTheMachineLacksIsReplaced) {
  EXPECT_TRUE(is_supported(SimdLevel::kPortable));
  EXPECT_TRUE(is_supported(SimdLevel::kBest));
  if (is_supported(SimdLevel::kAvx512)) {
    EXPECT_TRUE(is_supported(SimdLevel::kAvx2));
  }
  for (const SimdLevel level : kLevels) {
    if (!is_supported(level)) {
      std::printf("this machine has no level %d\n", static_cast<int>(level));
    }
  }
}

/// A polygon's segments: one a line, of lines one below the other.
Segments random_polygon(std::mt19937& random, std::int32_t width,
                        std::int32_t height) {
  const auto below = [&](std::int32_t end) {
    return static_cast<std::int32_t>(random() %
                                     static_cast<std::uint32_t>(end));
  };
  Segments objects;
  const bool whole = below(4) == 0;
  const std::int32_t first = below(height + 4) - 2;
  const std::int32_t count = 1 + below(height);
  for (std::int32_t j = first; j < first + count; ++j) {
    if (below(9) == 0) continue;
    const std::int32_t left = whole ? below(3) - 2 : below(width + 9) - 4;
    const std::int32_t right = whole ? width : left + below(width);
    objects.push_back({j, {left, right}});
  }
  // One polygon after another may be given at once.
  if (below(3) == 0) objects.insert(objects.end(), {{first, {0, 9}}});
  return objects;
}

/// Against a screen of a byte a pixel: longest runs of every segment.
TEST(DynamicScreen, SegmentsOfManyLinesLightWhatPixelsSay) {
  for (const SimdLevel level : kLevels) {
    std::mt19937 random(3);
    for (const auto& [width, height] :
         {std::pair{1, 1}, {31, 8}, {32, 8}, {33, 9}, {100, 20}, {2100, 17}}) {
      DynamicScreen screen(width, height, level);
      Grid2<std::uint8_t> lit(width, height, 0);
      for (int k = 0; k < 60; ++k) {
        if (k == 30) {
          screen.clear();
          lit = Grid2<std::uint8_t>(width, height, 0);
        }
        const Segments objects = random_polygon(random, width, height);
        Segments expected;
        for (const auto& [j, span] : objects) {
          bool runs_on = false;
          for (std::int32_t i = span.first; i <= span.last; ++i) {
            const bool on = i >= 0 && i < width && j >= 0 && j < height;
            const bool is_new = on && lit.at(i, j) == 0;
            if (is_new) lit.at(i, j) = 1;
            if (is_new && runs_on) expected.back().span.last = i;
            if (is_new && !runs_on) expected.push_back({j, {i, i}});
            runs_on = is_new;
          }
        }
        ASSERT_EQ(lit_by(screen, objects), expected);
        for (std::int32_t j = 0; j < height; ++j) {
          std::vector<Span> unlit;
          for (std::int32_t i = 0; i < width; ++i) {
            if (lit.at(i, j) != 0) continue;
            if (unlit.empty() || unlit.back().last + 1 != i) {
              unlit.push_back({i, i});
            }
            unlit.back().last = i;
          }
          ASSERT_EQ(screen.unlit(j), unlit);
        }
        const bool full =
            std::count(lit.pixels.begin(), lit.pixels.end(), 0) == 0;
        ASSERT_EQ(screen.full(), full);
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::fast
