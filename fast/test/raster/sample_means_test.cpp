#include "raster/sample_means.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "halfspace/fast/render.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "raster/pixel_gradient.hpp"

namespace halfspace::fast {
namespace {

constexpr std::array kKernelLevels = {SimdLevel::kPortable, SimdLevel::kAvx2,
                                      SimdLevel::kAvx512};

TEST(PixelMeans, ColorsAreAddedUpByEachKernel) {
  std::mt19937 random(7);
  for (const std::int32_t samples : {2, 4, 8}) {
    for (const std::int32_t pixels : {1, 5, 37}) {
      const std::int32_t stride = pixels * samples;
      std::vector<Rgb> colors(static_cast<std::size_t>(stride * samples));
      for (Rgb& color : colors) {
        // Greatest sums, too.
        const auto channel = [&] {
          return static_cast<std::uint8_t>(pixels == 1 ? 255 : random() % 256);
        };
        color = {channel(), channel(), channel()};
      }
      for (const SimdLevel level : kKernelLevels) {
        std::vector<Rgb> means(static_cast<std::size_t>(pixels));
        ColorMeans(samples, best_kernel(level))
            .row(colors.data(), stride, means.data());
        for (std::int32_t i = 0; i < pixels; ++i) {
          std::array<int, 3> sum = {};
          for (std::int32_t k = 0; k < samples * samples; ++k) {
            const Rgb& one = colors[static_cast<std::size_t>(
                k / samples * stride + i * samples + k % samples)];
            sum[0] += one.r;
            sum[1] += one.g;
            sum[2] += one.b;
          }
          const auto mean = [&](std::size_t c) {
            const int count = samples * samples;
            return static_cast<std::uint8_t>((2 * sum[c] + count) /
                                             (2 * count));
          };
          const Rgb expected = {mean(0), mean(1), mean(2)};
          ASSERT_EQ(means[static_cast<std::size_t>(i)], expected)
              << samples << ' ' << pixels << ' ' << i;
        }
      }
    }
  }
}

/// Colours that change by some levels a sample, and depths by `steepness`.
Gradient sloping(std::mt19937& random, double steepness) {
  std::uniform_real_distribution<double> slope(-2, 2);
  Gradient g = {};
  g.a[3] = steepness * slope(random);
  g.b[3] = steepness * slope(random);
  g.c[3] = 100;
  for (std::size_t c = 0; c < 3; ++c) {
    g.a[c] = 50 * slope(random);
    g.b[c] = 50 * slope(random);
    g.c[c] = 100 * (127 + 30 * slope(random));
  }
  g.doubt = 1e-9;
  return g;
}

template <std::int32_t kSamples>
std::array<long double, 3> sums_of(const Gradient& g, std::uint64_t bits,
                                   std::int32_t i, std::int32_t j) {
  std::array<long double, 3> sums = {};
  for (std::int32_t k = 0; k < kSamples * kSamples; ++k) {
    if ((bits >> k & 1) == 0) continue;
    const auto value = [&](std::size_t f) {
      return static_cast<long double>(g.a[f]) * (i + k % kSamples) +
             static_cast<long double>(g.b[f]) * (j + k / kSamples) + g.c[f];
    };
    for (std::size_t c = 0; c < 3; ++c) sums[c] += value(c) / value(3);
  }
  return sums;
}

template <std::int32_t kSamples>
Rgb rounded(const std::array<long double, 3>& sums) {
  const auto level = [&](std::size_t c) {
    return static_cast<std::uint8_t>(
        std::floor(sums[c] / (kSamples * kSamples) + 0.5L));
  };
  return {level(0), level(1), level(2)};
}

/// Whether it is one of what is seen: kernels need not know any other.
template <std::int32_t kSamples>
bool is_color(const std::array<long double, 3>& sums) {
  return std::all_of(sums.begin(), sums.end(), [](long double sum) {
    return sum >= 0 && sum <= 255 * kSamples * kSamples;
  });
}

/// What is decided is right, and nearly all is.
template <std::int32_t kSamples>
void expect_runs(const TileKernel& kernel) {
  std::mt19937 random(kSamples);
  int decided = 0;
  int compared = 0;
  int all = 0;
  for (int turn = 0; turn < 300; ++turn) {
    const double steepness =
        std::array{0.0, 0.1, 1.0}[static_cast<std::size_t>(turn % 3)];
    const Gradient g = sloping(random, steepness);
    const std::int32_t count = 1 + turn % 9;
    const std::int32_t j = turn % 3 * kSamples;
    std::int32_t first = 0;
    while (first < count) {
      std::array<Rgb, 10> means;
      means.fill({1, 2, 3});
      const std::int32_t done = kernel.full_means(
          g, kSamples, first * kSamples, j, count - first, &means[0].r);
      ASSERT_LE(done, count - first);
      for (std::int32_t k = 0; k < done; ++k) {
        const auto sums =
            sums_of<kSamples>(g, ~std::uint64_t{0}, (first + k) * kSamples, j);
        if (!is_color<kSamples>(sums)) continue;
        ++compared;
        ASSERT_EQ(means[static_cast<std::size_t>(k)], rounded<kSamples>(sums))
            << turn << ' ' << first + k;
      }
      // Nothing is written behind them.
      ASSERT_EQ(means[static_cast<std::size_t>(done)], (Rgb{1, 2, 3}));
      decided += done;
      all += std::min(done + 1, count - first);
      first += done + 1;
    }
  }
  EXPECT_GT(decided, all * 3 / 4);
  EXPECT_GT(compared, 700);
}

template <std::int32_t kSamples>
void expect_mixed(const TileKernel& kernel) {
  constexpr std::int32_t kAllSamples = kSamples * kSamples;
  std::mt19937 random(kSamples);
  int decided = 0;
  constexpr int kTimes = 600;
  for (int turn = 0; turn < kTimes; ++turn) {
    const double steepness =
        std::array{0.0, 0.02, 0.5}[static_cast<std::size_t>(turn % 3)];
    const std::array own = {sloping(random, steepness),
                            sloping(random, steepness)};
    std::array<std::uint64_t, 2> bits = {};
    std::array<std::int32_t, 4> whole = {};
    for (std::int32_t k = 0; k < kAllSamples; ++k) {
      const auto part = random() % 3;
      if (part < 2) bits[part] |= std::uint64_t{1} << k;
      if (part == 2) whole = {whole[0] + 255, whole[1] + 7, whole[2], 0};
    }
    std::array<MeanPart, 2> parts;
    std::array<long double, 3> sums = {static_cast<long double>(whole[0]),
                                       static_cast<long double>(whole[1]),
                                       static_cast<long double>(whole[2])};
    for (std::size_t p = 0; p < 2; ++p) {
      parts[p] = {&own[p], moments_of<kSamples>(bits[p])};
      const auto more = sums_of<kSamples>(own[p], bits[p], 3 * kSamples, 0);
      for (std::size_t c = 0; c < 3; ++c) sums[c] += more[c];
    }
    Rgb mean = {1, 2, 3};
    if (!kernel.mixed_mean(parts.data(), 2, whole.data(), kSamples,
                           3 * kSamples, 0, &mean.r)) {
      ASSERT_EQ(mean, (Rgb{1, 2, 3}));
      continue;
    }
    if (!is_color<kSamples>(sums)) continue;
    ++decided;
    ASSERT_EQ(mean, rounded<kSamples>(sums)) << turn;
  }
  EXPECT_GT(decided, kTimes / 2);
}

TEST(PixelMeans, WhatKernelsDecideIsRight) {
  for (const SimdLevel level : kKernelLevels) {
    const TileKernel& kernel = best_kernel(level);
    if (kernel.full_means == nullptr) continue;
    expect_runs<2>(kernel);
    expect_runs<4>(kernel);
    expect_runs<8>(kernel);
    expect_mixed<2>(kernel);
    expect_mixed<4>(kernel);
    expect_mixed<8>(kernel);
  }
}

TEST(PixelMeans, KernelsDecideNothingThatIsNotKnown) {
  std::mt19937 random(1);
  const Gradient sound = sloping(random, 0.1);
  std::vector<Gradient> bad(4, sound);
  bad[0].c[3] = -1000;         // behind the eye
  bad[1].doubt = 1e9;          // a total too small to trust
  bad[2].c[3] = std::nan("");  // no number
  bad[3].a[3] = 60;            // far too steep
  for (const SimdLevel level : kKernelLevels) {
    const TileKernel& kernel = best_kernel(level);
    if (kernel.full_means == nullptr) continue;
    std::array<Rgb, 4> means = {};
    EXPECT_GT(kernel.full_means(sound, 4, 0, 0, 4, &means[0].r), 0);
    const std::array<std::int32_t, 4> none = {};
    for (const Gradient& gradient : bad) {
      EXPECT_EQ(kernel.full_means(gradient, 4, 0, 0, 4, &means[0].r), 0);
      const std::array<MeanPart, 2> parts = {
          {{&sound, moments_of<4>(0x00ff)},
           {&gradient, moments_of<4>(0xff00)}}};
      EXPECT_FALSE(kernel.mixed_mean(parts.data(), 2, none.data(), 4, 0, 0,
                                     &means[0].r));
    }
    // Half a step is left to what is exact; whole numbers are rounded half up.
    const std::array<std::int32_t, 4> step = {8, 24, 40, 0};
    Rgb mean;
    EXPECT_TRUE(kernel.mixed_mean(nullptr, 0, step.data(), 4, 0, 0, &mean.r));
    EXPECT_EQ(mean, (Rgb{1, 2, 3}));
    Gradient half = {};
    half.c[3] = 1;
    half.c[0] = half.c[1] = half.c[2] = 7.5;
    EXPECT_EQ(kernel.full_means(half, 4, 0, 0, 4, &means[0].r), 0);
  }
}

}  // namespace
}  // namespace halfspace::fast
