#include "raster/gouraud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "camera/view.hpp"
#include "no_fallback.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "raster/tile_buffer.hpp"
#include "scenes.hpp"

/// Colours that the kernels do not ask about are the right ones, however their
/// gradients are off within their doubt.
namespace halfspace::fast {
namespace {

constexpr std::int32_t kSampleWidth = 75;
constexpr std::int32_t kSampleHeight = 19;

/// Gradients, and what was asked.
struct Asked : NoFallback {
  const Gradient& gradient() override { return colors; }
  void shade(const PixelSource&, std::int32_t x, std::int32_t y,
             std::uint32_t bits, std::uint8_t*, std::int64_t) override {
    for (std::int32_t k = 0; k < 32; ++k) {
      if (((bits >> k) & 1u) == 0) continue;
      pixels[static_cast<std::size_t>(y * kSampleWidth + x + k)] = true;
    }
  }
  Gradient colors{};
  std::vector<bool> pixels = std::vector<bool>(kSampleWidth * kSampleHeight);
};

class Random {
 public:
  double from_to(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  /// Totals of about `size`, levels from 0 to 255 at the image's corners, and
  /// so everywhere.
  Gradient gradient(double size) {
    Gradient g{};
    const auto enter = [&g](std::size_t f, double at, double right,
                            double down) {
      g.a[f] = (right - at) / kSampleWidth;
      g.b[f] = (down - at) / kSampleHeight;
      g.c[f] = at;
    };
    // Totals that hardly change are often meant, and seldom told apart.
    const double steep = 0.45 * std::pow(from_to(0, 1), 8);
    std::array<double, 3> total;
    for (double& t : total) t = size * (1 + from_to(-steep, steep));
    enter(3, total[0], total[1], total[2]);
    for (std::size_t f = 0; f < 3; ++f) {
      while (true) {
        std::array<double, 3> level;
        for (double& l : level) l = from_to(0, 255);
        enter(f, level[0] * total[0], level[1] * total[1], level[2] * total[2]);
        const double last =
            (level[1] * total[1] + level[2] * total[2] - level[0] * total[0]) /
            (total[1] + total[2] - total[0]);
        if (last >= 0 && last <= 255) break;
      }
    }
    return g;
  }

 private:
  std::mt19937_64 engine_{11};
};

/// Draws a gradient all over an image and compares what was not asked about.
void expect_told(const TileKernel& kernel, const Gradient& gradient,
                 std::size_t& told, std::size_t& doubtful) {
  Asked asked;
  asked.colors = gradient;
  Rendering result;
  result.colors = ColorImage(kSampleWidth, kSampleHeight, Rgb{});
  TileBuffer buffer({0, 0, kSampleWidth, kSampleHeight}, {0, kSampleHeight},
                    result, false);
  const double x[4] = {-9, kSampleWidth + 9, kSampleWidth + 9, -9};
  const double y[4] = {-9, -9, kSampleHeight + 9, kSampleHeight + 9};
  buffer.view().exact = &asked;
  PixelSource source;
  source.color = PixelSource::kSmooth;
  kernel.draw(buffer.view(), {x, y, 4, 0, 1}, source);
  kernel.fill_rest(buffer.view(), {});
  const Gradient& g = gradient;
  for (std::int32_t j = 0; j < kSampleHeight; ++j) {
    for (std::int32_t i = 0; i < kSampleWidth; ++i) {
      const auto at = [&](std::size_t f) {
        return g.a[f] * i + g.b[f] * j + g.c[f];
      };
      const double doubt = g.doubt / at(3);
      const Rgb& drawn = result.colors.at(i, j);
      const std::array<int, 3> levels = {drawn.r, drawn.g, drawn.b};
      bool may_change = false;
      for (std::size_t c = 0; c < 3; ++c) {
        const double half_up = at(c) / at(3) + 0.5;
        may_change = may_change ||
                     std::floor(half_up - doubt) != std::floor(half_up + doubt);
      }
      doubtful += may_change ? 1 : 0;
      if (asked.pixels[static_cast<std::size_t>(j * kSampleWidth + i)])
        continue;
      ASSERT_FALSE(may_change) << i << ", " << j;
      ++told;
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_EQ(levels[c], std::floor(at(c) / at(3) + 0.5))
            << i << ", " << j << ", channel " << c;
      }
    }
  }
}

TEST(ShadeBounds, ColorsAskWhereTheirDoubtMatters) {
  for (const TileKernel* kernel :
       {&kPortableKernel, &best_kernel(SimdLevel::kAvx2), &best_kernel()}) {
    Random random;
    std::size_t told = 0;
    std::size_t doubtful = 0;
    for (int round = 0; round < 300; ++round) {
      const double size = std::ldexp(1.0, 3 * round);
      Gradient gradient = random.gradient(size);
      gradient.doubt = random.from_to(0, 0.01) * size;
      expect_told(*kernel, gradient, told, doubtful);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(told, 300'000u);
    EXPECT_GT(doubtful, 1000u);
  }
}

/// What floats are off alone.
TEST(ShadeBounds, ColorsAskWhereRoundingMatters) {
  for (const TileKernel* kernel :
       {&kPortableKernel, &best_kernel(SimdLevel::kAvx2), &best_kernel()}) {
    Random random;
    std::size_t told = 0;
    std::size_t doubtful = 0;
    for (int round = 0; round < 1500; ++round) {
      expect_told(*kernel, random.gradient(1), told, doubtful);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(told, 2'000'000u);
    EXPECT_EQ(doubtful, 0u);
  }
}

using Long = long double;
using Vector = std::array<Long, 3>;

Vector minus(const Vector& u, const Vector& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}

Long volume(const Vector& u, const Vector& v, const Vector& w) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) +
         u[1] * (v[2] * w[0] - v[0] * w[2]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

Vector in_steps(const LatticeVector& v, Long unit) {
  return {static_cast<Long>(v.x) / unit, static_cast<Long>(v.y) / unit,
          static_cast<Long>(v.z) / unit};
}

/// The channels that the centre of pixel (i, j) sees of the only triangle: its
/// weights are twice the volumes of that point, the eye and each edge.
Vector levels_at(const Scene& scene, const CameraData& camera, int i, int j) {
  const Vector eye = in_steps(camera.eye, camera.perspective ? 256 : 1);
  Vector s = in_steps(camera.s0, 256);
  const Vector sx = in_steps(camera.sx, 256);
  const Vector sy = in_steps(camera.sy, 256);
  for (std::size_t a = 0; a < 3; ++a) {
    s[a] += (i + 0.5L) * sx[a] + (j + 0.5L) * sy[a];
  }
  const auto corner = [&](std::size_t c) {
    const GridPoint& p = scene.point(scene.corners(0)[c % 3]);
    return Vector{Long(p.x), Long(p.y), Long(p.z)};
  };
  Vector sums{};
  Long total = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector p = corner(k + 1);
    const Vector q = corner(k + 2);
    const Long weight = camera.perspective
                            ? volume(minus(q, eye), minus(p, q), minus(s, eye))
                            : volume(eye, minus(q, p), minus(s, p));
    const Rgb color = scene.corner_colors(0)[k];
    sums[0] += weight * color.r;
    sums[1] += weight * color.g;
    sums[2] += weight * color.b;
    total += weight;
  }
  return {sums[0] / total, sums[1] / total, sums[2] / total};
}

/// A triangle and a camera anywhere on the grid, if they are valid.
struct Shot {
  explicit Shot(Random& random) {
    const auto point = [&](double size) -> GridPoint {
      const auto one = [&] {
        return static_cast<std::int64_t>(random.from_to(-size, size));
      };
      return {one(), one(), one()};
    };
    const auto lattice = [&](double size) {
      const GridPoint p = point(size);
      return LatticeVector{p.x, p.y, p.z};
    };
    SceneData data;
    add_polygon(data, {point(0x1p24), point(0x1p24), point(0x1p24)});
    data.corner_colors = {{255, 0, 0}, {0, 255, 0}, {100, 0, 255}};
    scene = make_scene(std::move(data));
    CameraData seen;
    seen.perspective = random.from_to(0, 1) < 0.5;
    // Only the direction towards the viewer may have any length.
    const double length = std::exp2(std::floor(random.from_to(8, 33)));
    seen.eye = lattice(seen.perspective ? 0x1p32 : length);
    seen.s0 = lattice(0x1p32);
    seen.sx = lattice(0x1p26);
    seen.sy = lattice(0x1p26);
    seen.width_px = seen.height_px = 64;
    camera = make_camera(seen, 26);
  }
  Result<Scene> scene = Scene();
  Result<Camera> camera = Error{};
};

TEST(ShadeBounds, OfGradients) {
  Random random;
  double largest = 0;
  std::size_t told = 0;
  std::size_t shaded = 0;
  for (int round = 0; round < 4000; ++round) {
    const Shot shot(random);
    if (!shot.scene || !shot.camera) continue;
    const View view = make_view(*shot.camera, 26);
    GouraudShader shader(*shot.scene, shot.camera->data(), view);
    for (const int i : {0, 31, 63}) {
      const int j = 63 - i;
      const Vector exact = levels_at(*shot.scene, shot.camera->data(), i, j);
      const auto at = [&](std::size_t f) {
        const Gradient& g = shader.gradient();
        return g.a[f] * i + (g.b[f] * j + g.c[f]);
      };
      // The eye is on the side from which the total is positive.
      shader.start(0, 1);
      if (at(3) < 0) shader.start(0, -1);
      // In the triangle, and away from where rounding takes a step.
      bool is_inside = true;
      for (const Long level : exact) {
        const Long above = level + 0.5L - std::floor(level + 0.5L);
        is_inside = is_inside && level > 0 && level < 255 && above > 1e-5L &&
                    above < 1 - 1e-5L;
      }
      if (is_inside) {
        std::uint8_t colors[3];
        const int asked = shader.shade(i, j, 1, colors, 0);
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_EQ(colors[c], std::floor(exact[c] + 0.5L));
        }
        // Integers are asked where that matters, and seldom else.
        if (shader.gradient().doubt < 1e-5 * at(3)) {
          ASSERT_EQ(asked, 0);
        }
        ++shaded;
      }
      const double doubt = shader.gradient().doubt / at(3);
      if (!(doubt < 0.25)) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const double level = at(c) / at(3);
        // Outside the triangle a level may be any number.
        if (!(std::abs(level) <= 256)) continue;
        ++told;
        const auto off = static_cast<double>(std::abs(level - exact[c]));
        ASSERT_LE(off, doubt);
        largest = std::max(largest, off / doubt);
      }
    }
  }
  EXPECT_GT(told, 3000u);
  EXPECT_GT(shaded, 100u);
  EXPECT_GT(largest, 0x1p-16);
}

TEST(ShadeBounds, OfGradientsInParallelViewsOfAnyDirection) {
  SceneData data;
  add_polygon(data, {{0, 0, 0}, {1 << 20, 0, 0}, {0, 1 << 20, 0}});
  data.corner_colors = {{255, 0, 0}, {0, 255, 0}, {100, 0, 255}};
  const Result<Scene> scene = make_scene(std::move(data));
  ASSERT_TRUE(scene);
  for (int bits = 0; bits <= 32; bits += 4) {
    CameraData seen;
    seen.perspective = false;
    seen.eye = {0, 0, std::int64_t{1} << bits};
    seen.s0 = {0, 0, std::int64_t{1} << 30};
    seen.sx = {1 << 22, 0, 0};
    seen.sy = {0, 1 << 22, 0};
    seen.width_px = seen.height_px = 64;
    const Result<Camera> camera = make_camera(seen, 26);
    ASSERT_TRUE(camera) << camera.error().message;
    const View view = make_view(*camera, 26);
    GouraudShader shader(*scene, camera->data(), view);
    shader.start(0, 1);
    const Gradient& g = shader.gradient();
    // A total of 2^40 times the direction's length.
    EXPECT_LT(g.doubt / std::abs(g.c[3]), 0x1p-20) << bits;
  }
}

}  // namespace
}  // namespace halfspace::fast
