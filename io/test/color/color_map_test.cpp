#include "halfspace/io/color_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "halfspace/io/legend.hpp"

namespace halfspace::io {
namespace {

int lightness(const Rgb& c) { return 299 * c.r + 587 * c.g + 114 * c.b; }

TEST(ColorMap, MapsBeginAndEndAsTheirAuthorsSay) {
  const auto ends = [](const char* name) {
    const ColorMap map = *named_color_map(name);
    EXPECT_EQ(map.size(), 256u) << name;
    return std::pair(map.front(), map.back());
  };
  using Ends = std::pair<Rgb, Rgb>;
  EXPECT_EQ(ends("viridis"), (Ends{{68, 1, 84}, {253, 231, 37}}));
  EXPECT_EQ(ends("cividis"), (Ends{{0, 34, 78}, {254, 232, 56}}));
  EXPECT_EQ(ends("turbo"), (Ends{{48, 18, 59}, {122, 4, 3}}));
  EXPECT_EQ(ends("heated"), (Ends{{0, 0, 0}, {255, 255, 255}}));
  EXPECT_EQ(ends("grey"), (Ends{{0, 0, 0}, {255, 255, 255}}));
  EXPECT_EQ(ends("coolwarm"), (Ends{{59, 76, 192}, {180, 4, 38}}));
  EXPECT_EQ(ends("grey_r"), (Ends{{255, 255, 255}, {0, 0, 0}}));
  EXPECT_FALSE(named_color_map("sunny").has_value());
}

TEST(ColorMap, SequentialMapsGetLighterAndTheDivergingOneHasAPaleMiddle) {
  for (const char* name : {"heated", "grey", "viridis", "cividis"}) {
    const ColorMap map = *named_color_map(name);
    for (std::size_t k = 1; k < map.size(); ++k) {
      EXPECT_GE(lightness(map[k]) + 1000, lightness(map[k - 1]))
          << name << " " << k;
    }
  }
  const ColorMap map = *named_color_map("coolwarm");
  // Moreland's table has (221, 221, 221) in the middle.
  for (const int channel : {map[127].r, map[127].g, map[127].b})
    EXPECT_NEAR(channel, 221, 2);
}

TEST(ColorScale, StepsAreTheNearestDoubles) {
  const ColorMap map = *named_color_map("grey");
  const ColorScale scale = *make_scale(map, {.low = 0, .high = 256});
  ASSERT_EQ(scale.steps.size(), 255u);
  for (std::size_t k = 0; k < 255; ++k)
    EXPECT_EQ(scale.steps[k], static_cast<double>(k + 1));
  EXPECT_TRUE(is_valid(scale));
  EXPECT_FALSE(scale.limits.has_value());
  const ColorScale decades = *make_scale(map, {.low = 1e-3,
                                               .high = 1e3,
                                               .logarithmic = true,
                                               .steps = 6,
                                               .clamp = false});
  EXPECT_EQ(decades.steps, (std::vector<double>{1e-2, 1e-1, 1, 10, 100}));
  EXPECT_EQ(decades.colors[0], (Rgb{21, 21, 21}));
  EXPECT_EQ(decades.limits->low, 1e-3);
  EXPECT_EQ(decades.limits->color, decades.no_data);
}

TEST(ColorScale, BandsThatAreNoDoublesApartAreLeftOut) {
  const double next = std::nextafter(std::nextafter(1.0, 2.0), 2.0);
  const ColorScale scale =
      *make_scale(*named_color_map("grey"), {.low = 1, .high = next});
  EXPECT_TRUE(is_valid(scale));
  EXPECT_LE(scale.steps.size(), 2u);
}

TEST(ColorScale, BadRangesAreErrors) {
  const ColorMap map = *named_color_map("grey");
  const auto code = [&](const ScaleRange& range) {
    return make_scale(map, range).error().code;
  };
  EXPECT_EQ(code({.low = 1, .high = 1}), ErrorCode::kOutOfRange);
  EXPECT_EQ(code({.low = 0, .high = 1, .logarithmic = true}),
            ErrorCode::kOutOfRange);
  EXPECT_EQ(code({.low = 0, .high = HUGE_VAL}), ErrorCode::kNotFinite);
  EXPECT_EQ(code({.low = 0, .high = 1, .steps = 1}), ErrorCode::kOutOfRange);
}

TEST(ScaleMarks, AreRoundNumbersWithinTheRange) {
  const auto texts = [](const ScaleRange& range, int most) {
    std::string all;
    for (const ScaleMark& mark : scale_marks(range, most))
      all += mark.text + " ";
    return all;
  };
  EXPECT_EQ(texts({.low = 0, .high = 1}, 5), "0 0.2 0.4 0.6 0.8 1 ");
  EXPECT_EQ(texts({.low = -3.2, .high = 8.1}, 6), "-2 0 2 4 6 8 ");
  EXPECT_EQ(texts({.low = 1, .high = 1000, .logarithmic = true}, 5),
            "1 10 100 1000 ");
  EXPECT_EQ(texts({.low = 1, .high = 100, .logarithmic = true}, 9),
            "1 2 5 10 20 50 100 ");
  for (const ScaleMark& mark : scale_marks({.low = -3.2, .high = 8.1}, 6)) {
    EXPECT_NEAR(mark.share, (mark.value + 3.2) / 11.3, 1e-12);
  }
}

TEST(Legend, StandsAtTheRightAndLeavesTheRestAlone) {
  ColorImage picture(320, 240, Rgb{255, 255, 255});
  const ItemImage items(320, 240, kBackground);
  Legend legend;
  legend.range = {.low = 0, .high = 1};
  legend.scale = *make_scale(*named_color_map("viridis"), legend.range);
  legend.title = "heat";
  draw_legend(legend, items, {255, 255, 255}, picture);
  std::size_t changed = 0;
  std::size_t top = 0;
  std::size_t bottom = 0;
  for (std::int32_t j = 0; j < 240; ++j) {
    for (std::int32_t i = 0; i < 320; ++i) {
      if (picture.at(i, j) == Rgb{255, 255, 255}) continue;
      ++changed;
      EXPECT_GT(i, 200);
      top += picture.at(i, j) == legend.scale.colors.back() ? 1u : 0u;
      bottom += picture.at(i, j) == legend.scale.colors.front() ? 1u : 0u;
    }
  }
  EXPECT_GT(changed, 1000u);
  EXPECT_GT(top, 3u);
  EXPECT_GT(bottom, 3u);
  // Too small a picture has none.
  ColorImage small(20, 10, Rgb{});
  draw_legend(legend, ItemImage(20, 10, kBackground), {}, small);
  EXPECT_EQ(small, ColorImage(20, 10, Rgb{}));
}

}  // namespace
}  // namespace halfspace::io
