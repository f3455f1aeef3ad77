#include "raster/sample_means.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "raster/pixel_gradient.hpp"
#include "scenes.hpp"

namespace halfspace::fast {
namespace {

constexpr std::array kKernelLevels = {SimdLevel::kPortable, SimdLevel::kAvx2,
                                      SimdLevel::kAvx512};

/// Two triangles that cross, of the greatest colour and of a small one, before
/// a background of the greatest.
TEST(PixelMeans, ColorsAreAddedUpByEachKernel) {
  constexpr std::int64_t kSide = 1 << 20;
  SceneData data;
  add_polygon(data, {{-kSide, -kSide, -kSide / 9},
                     {kSide, -kSide / 3, kSide / 7},
                     {-kSide / 2, kSide, kSide / 5}});
  add_polygon(data, {{-kSide, kSide / 2, -kSide / 3},
                     {kSide, kSide / 3, -kSide / 8},
                     {kSide / 3, -kSide, kSide / 2}});
  data.colors = {{255, 255, 255}, {1, 2, 3}};
  const Scene scene = made(std::move(data));
  const BspTree tree = build_display_tree(scene);
  constexpr std::int32_t kWide = 75;
  constexpr std::int32_t kHigh = 61;
  CameraData seen;
  seen.eye = {0, 0, -4 * 256 * kSide};
  seen.s0 = {-256 * kSide, -256 * kSide, 0};
  seen.sx = {512 * kSide / kWide, 0, 0};
  seen.sy = {0, 512 * kSide / kHigh, 0};
  seen.width_px = kWide;
  seen.height_px = kHigh;
  const Camera camera = *make_camera(seen, 26);
  ImageOptions look;
  look.shading = Shading::kFlat;
  look.background = {255, 255, 255};
  const std::array<Rgb, 3> colors = {look.background, scene.color(0),
                                     scene.color(1)};
  for (const std::int32_t samples : {2, 4, 8}) {
    const ItemImage items =
        render_samples(scene, tree, camera, look, samples, {}).items;
    const auto mean_at = [&](std::int32_t i, std::int32_t j) {
      std::array<int, 3> sum = {};
      for (std::int32_t k = 0; k < samples * samples; ++k) {
        const PolygonId item =
            items.at(i * samples + k % samples, j * samples + k / samples);
        const Rgb& one = colors[static_cast<std::size_t>(item + 1)];
        sum[0] += one.r;
        sum[1] += one.g;
        sum[2] += one.b;
      }
      const auto mean = [&](std::size_t c) {
        const int count = samples * samples;
        return static_cast<std::uint8_t>((2 * sum[c] + count) / (2 * count));
      };
      return Rgb{mean(0), mean(1), mean(2)};
    };
    std::size_t mixed = 0;
    for (const Rectangle& part :
         {Rectangle{0, 0, kWide, kHigh}, Rectangle{1, 3, 74, 60},
          Rectangle{9, 5, 13, 11}, Rectangle{37, 30, 38, 31}}) {
      for (const SimdLevel level : kKernelLevels) {
        for (const int threads : {1, 3}) {
          RenderOptions how;
          how.items = false;
          how.threads = threads;
          how.simd = level;
          how.rectangle = part;
          const Rendering drawn =
              render_samples(scene, tree, camera, look, samples, how);
          EXPECT_TRUE(drawn.items.pixels.empty());
          for (std::int32_t j = part.top; j < part.bottom; ++j) {
            for (std::int32_t i = part.left; i < part.right; ++i) {
              const Rgb mean = mean_at(i, j);
              ASSERT_EQ(drawn.colors.at(i - part.left, j - part.top), mean)
                  << samples << ' ' << i << ' ' << j;
              mixed += mean.r != 255 && mean.r != 1 ? 1 : 0;
            }
          }
        }
      }
    }
    EXPECT_GT(mixed, 100u);
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
