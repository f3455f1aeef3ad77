#include "raster/pixel_gradient.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace halfspace::fast {
namespace {

/// Strong perspective: over a pixel of 4 x 4 samples the divisor changes by an
/// eighth of itself or so, and terms of each order are above the bound.
Gradient steep(double share) {
  Gradient g = {};
  const double across[4] = {90, -40, 7, 1};
  const double down[4] = {-30, 55, 0, -1.25};
  const double at[4] = {9000, 14000, 20000, 100};
  for (std::size_t f = 0; f < 4; ++f) {
    g.a[f] = share * across[f];
    g.b[f] = share * down[f];
    g.c[f] = at[f];
  }
  return g;
}

template <std::int32_t kSamples>
void expect_sums(const Gradient& g, std::uint64_t bits) {
  constexpr std::int32_t kRow = 12, kColumn = 8;
  ChannelSums sums;
  PixelGradient<kSamples>(g, kColumn, kRow)
      .add(moments_of<kSamples>(bits), sums);
  ASSERT_LT(sums.doubt, 1) << "nothing is shown";
  std::array<double, 3> expected = {};
  for (std::int32_t k = 0; k < kSamples * kSamples; ++k) {
    if ((bits >> k & 1) == 0) continue;
    const double u = kColumn + k % kSamples;
    const double v = kRow + k / kSamples;
    const auto value = [&](std::size_t f) {
      return g.a[f] * u + g.b[f] * v + g.c[f];
    };
    for (std::size_t c = 0; c < 3; ++c) expected[c] += value(c) / value(3);
  }
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(sums.sum[c], expected[c], sums.doubt) << bits << " " << c;
}

TEST(PixelGradient, SumsAreWithinTheirBounds) {
  for (const double share : {1.0, 0.25, 0.01}) {
    for (std::uint64_t bits = 1; bits < 0x10000; bits += 37)
      expect_sums<4>(steep(share), bits);
    for (std::uint64_t bits = 1; bits < 16; ++bits)
      expect_sums<2>(steep(share), bits);
    expect_sums<8>(steep(share / 4), 0x8040201008040201u);
    expect_sums<8>(steep(share / 4), 0xffff0000f0f00000u);
  }
}

TEST(PixelGradient, AllSamplesNeedNoOddMoments) {
  for (const double share : {1.0, 0.25, 0.01}) {
    ChannelSums all, one_by_one;
    const Gradient g = steep(share);
    const PixelGradient<4> pixel(g, 8, 12);
    pixel.add_all(all);
    pixel.add(moments_of<4>(0xffff), one_by_one);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(all.sum[c], one_by_one.sum[c], 1e-9);
    EXPECT_LT(all.doubt, one_by_one.doubt);
  }
}

TEST(PixelGradient, WhatIsNotKnownIsNotRounded) {
  Gradient behind = steep(1);
  behind.c[3] = -200;
  ChannelSums sums;
  PixelGradient<4>(behind, 8, 12).add_all(sums);
  EXPECT_FALSE(rounded_mean<16>(sums));
  // Whole numbers on a step are: half up.
  ChannelSums flat;
  flat.sum = {24, 32, 56};
  EXPECT_EQ(rounded_mean<16>(flat), (Rgb{2, 2, 4}));
}

}  // namespace
}  // namespace halfspace::fast
