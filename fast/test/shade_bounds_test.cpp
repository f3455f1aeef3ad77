#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "kernel.hpp"
#include "screen.hpp"
#include "shader.hpp"
#include "view.hpp"

/// Colours that the kernels do not ask about are the right ones, however their
/// gradients are off within their doubt.
namespace halfspace::fast {
namespace {

constexpr std::int32_t kWidth = 75;
constexpr std::int32_t kHeight = 19;

/// Gradients, and what was asked.
struct Asked {
  Gradient gradient{};
  std::vector<bool> pixels = std::vector<bool>(kWidth * kHeight);
};

Decider decider_of(Asked& asked) {
  Decider decider{};
  decider.gradient = [](void* context) -> const Gradient& {
    return static_cast<Asked*>(context)->gradient;
  };
  decider.shade = [](void* context, const Ink&, std::int32_t x, std::int32_t y,
                     std::uint32_t bits, std::uint8_t*, std::int64_t) {
    for (std::int32_t k = 0; k < 32; ++k) {
      if (((bits >> k) & 1u) == 0) continue;
      static_cast<Asked*>(context)
          ->pixels[static_cast<std::size_t>(y * kWidth + x + k)] = true;
    }
  };
  decider.context = &asked;
  return decider;
}

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
      g.a[f] = (right - at) / kWidth;
      g.b[f] = (down - at) / kHeight;
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
void expect_told(const Kernel& kernel, const Gradient& gradient,
                 std::size_t& told, std::size_t& doubtful) {
  Asked asked{gradient};
  Rendering result;
  result.colors = ColorImage(kWidth, kHeight, Rgb{});
  Screen screen({0, 0, kWidth, kHeight}, {0, kHeight}, result, false);
  const double x[4] = {-9, kWidth + 9, kWidth + 9, -9};
  const double y[4] = {-9, -9, kHeight + 9, kHeight + 9};
  Ink ink;
  ink.color = Ink::kSmooth;
  kernel.draw(screen.canvas(), {x, y, 4, 0, 1}, ink, decider_of(asked));
  kernel.fill_rest(screen.canvas(), {}, decider_of(asked));
  const Gradient& g = gradient;
  for (std::int32_t j = 0; j < kHeight; ++j) {
    for (std::int32_t i = 0; i < kWidth; ++i) {
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
      if (asked.pixels[static_cast<std::size_t>(j * kWidth + i)]) continue;
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
  for (const Kernel* kernel :
       {&kPlainKernel, &best_kernel(Loops::kAvx2), &best_kernel()}) {
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
  for (const Kernel* kernel :
       {&kPlainKernel, &best_kernel(Loops::kAvx2), &best_kernel()}) {
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

/// Gradients of triangles anywhere, against ones in long doubles.
TEST(ShadeBounds, OfGradients) {
  using Long = long double;
  using Vector = std::array<Long, 3>;
  Random random;
  double largest = 0;
  std::size_t told = 0;
  for (int round = 0; round < 4000; ++round) {
    const auto point = [&](double size) {
      const auto one = [&] {
        return static_cast<std::int64_t>(random.from_to(-size, size));
      };
      return std::array<std::int64_t, 3>{one(), one(), one()};
    };
    const auto lattice = [](const std::array<std::int64_t, 3>& v) {
      return LatticeVector{v[0], v[1], v[2]};
    };
    SceneData data;
    for (int k = 0; k < 3; ++k) {
      const auto p = point(0x1p24);
      data.vertices.push_back({p[0], p[1], p[2]});
      data.corners.push_back(static_cast<VertexId>(k));
    }
    data.first_corner.push_back(3);
    data.colors.push_back({});
    data.corner_colors = {{255, 0, 0}, {0, 255, 0}, {100, 0, 255}};
    const Result<Scene> scene = make_scene(std::move(data));
    CameraData camera_data;
    camera_data.perspective = round % 2 == 0;
    camera_data.eye = lattice(point(0x1p32));
    camera_data.s0 = lattice(point(0x1p32));
    camera_data.sx = lattice(point(0x1p26));
    camera_data.sy = lattice(point(0x1p26));
    camera_data.width_px = camera_data.height_px = 64;
    const Result<Camera> camera = make_camera(camera_data, 26);
    if (!scene || !camera) continue;
    const View view = make_view(*camera, 26);
    Shader shader(*scene, camera->data(), view);
    shader.start(0, 1);
    const Gradient& found = shader.gradient();

    // Twice the volumes, with the eye, of a pixel's centre and each edge.
    const auto steps = [](const LatticeVector& v, Long unit) {
      return Vector{static_cast<Long>(v.x) / unit,
                    static_cast<Long>(v.y) / unit,
                    static_cast<Long>(v.z) / unit};
    };
    const auto minus = [](const Vector& u, const Vector& v) {
      return Vector{u[0] - v[0], u[1] - v[1], u[2] - v[2]};
    };
    const auto volume = [](const Vector& u, const Vector& v, const Vector& w) {
      return u[0] * (v[1] * w[2] - v[2] * w[1]) +
             u[1] * (v[2] * w[0] - v[0] * w[2]) +
             u[2] * (v[0] * w[1] - v[1] * w[0]);
    };
    const bool perspective = camera_data.perspective;
    const Vector eye = steps(camera_data.eye, perspective ? 256 : 1);
    const Vector sx = steps(camera_data.sx, 256);
    const Vector sy = steps(camera_data.sy, 256);
    const Vector s0 = steps(camera_data.s0, 256);
    for (const int i : {0, 63}) {
      const int j = 63 - i;
      Vector s;
      for (std::size_t a = 0; a < 3; ++a) {
        s[a] = s0[a] + (i + 0.5L) * sx[a] + (j + 0.5L) * sy[a];
      }
      Long sums[4] = {0, 0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto corner = [&](std::size_t c) {
          const GridPoint& p = scene->point(scene->corners(0)[c % 3]);
          return Vector{Long(p.x), Long(p.y), Long(p.z)};
        };
        const Vector p = corner(k + 1);
        const Vector q = corner(k + 2);
        const Long weight =
            perspective ? volume(minus(q, eye), minus(p, q), minus(s, eye))
                        : volume(eye, minus(q, p), minus(s, p));
        const Rgb color = scene->corner_colors(0)[k];
        const Long levels[4] = {Long(color.r), Long(color.g), Long(color.b), 1};
        for (std::size_t f = 0; f < 4; ++f) sums[f] += levels[f] * weight;
      }
      const auto at = [&](std::size_t f) {
        return found.a[f] * i + (found.b[f] * j + found.c[f]);
      };
      const double doubt = found.doubt / std::abs(at(3));
      if (!(doubt < 0.25)) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const double level = at(c) / at(3);
        // Outside the triangle a level may be any number.
        if (!(std::abs(level) <= 256)) continue;
        ++told;
        const auto off = static_cast<double>(
            std::abs(static_cast<Long>(level) - sums[c] / sums[3]));
        ASSERT_LE(off, doubt);
        largest = std::max(largest, off / doubt);
      }
    }
  }
  EXPECT_GT(told, 3000u);
  EXPECT_GT(largest, 0x1p-16);
}

}  // namespace
}  // namespace halfspace::fast
