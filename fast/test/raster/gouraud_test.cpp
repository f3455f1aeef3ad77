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
#include "shade/exact_double.hpp"

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

/// Draws gradients that make(random, round) makes by each kernel, and calls
/// check(told, doubtful) for each.
template <class Make, class Check>
void expect_told_by_kernels(int rounds, const Make& make, const Check& check) {
  for (const TileKernel* kernel :
       {&kPortableKernel, &best_kernel(SimdLevel::kAvx2), &best_kernel()}) {
    Random random;
    std::size_t told = 0;
    std::size_t doubtful = 0;
    for (int round = 0; round < rounds; ++round) {
      expect_told(*kernel, make(random, round), told, doubtful);
      if (::testing::Test::HasFatalFailure()) return;
    }
    check(told, doubtful);
  }
}

TEST(ShadeBounds, ColorsAskWhereTheirDoubtMatters) {
  expect_told_by_kernels(
      300,
      [](Random& random, int round) {
        const double size = std::ldexp(1.0, 3 * round);
        Gradient gradient = random.gradient(size);
        gradient.doubt = random.from_to(0, 0.01) * size;
        return gradient;
      },
      [](std::size_t told, std::size_t doubtful) {
        EXPECT_GT(told, 300'000u);
        EXPECT_GT(doubtful, 1000u);
      });
}

/// What floats are off alone.
TEST(ShadeBounds, ColorsAskWhereRoundingMatters) {
  expect_told_by_kernels(
      1500, [](Random& random, int) { return random.gradient(1); },
      [](std::size_t told, std::size_t doubtful) {
        EXPECT_GT(told, 2'000'000u);
        EXPECT_EQ(doubtful, 0u);
      });
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

/// A triangle of `size` steps anywhere on the grid, and a camera as near to it
/// as it is large: most of each number is the place in the grid.
struct NearShot {
  NearShot(Random& random, int bits) {
    const double size = std::exp2(std::floor(random.from_to(6, bits - 5)));
    const double room = std::ldexp(1.0, bits - 1) - 16 * size;
    const auto one = [&](double range) {
      return static_cast<std::int64_t>(random.from_to(-range, range));
    };
    const GridPoint middle = {one(room), one(room), one(room)};
    const auto point = [&] {
      return GridPoint{middle.x + one(size), middle.y + one(size),
                       middle.z + one(size)};
    };
    const auto lattice = [&](const GridPoint& from, double range) {
      const std::int64_t x = one(range), y = one(range), z = one(range);
      return LatticeVector{Int128{from.x} * 256 + x, Int128{from.y} * 256 + y,
                           Int128{from.z} * 256 + z};
    };
    SceneData data;
    data.grid_bits = bits;
    add_polygon(data, {point(), point(), point()});
    data.corner_colors = {{255, 0, 0}, {0, 255, 0}, {100, 0, 255}};
    scene = make_scene(std::move(data));
    CameraData seen;
    seen.perspective = random.from_to(0, 1) < 0.5;
    seen.eye = seen.perspective ? lattice(middle, 2048 * size)
                                : lattice({}, std::min(size, 0x1p20));
    seen.s0 = lattice(middle, 512 * size);
    seen.sx = lattice({}, 8 * size);
    seen.sy = lattice({}, 8 * size);
    seen.width_px = seen.height_px = 64;
    camera = make_camera(seen, bits);
  }
  Result<Scene> scene = Scene();
  Result<Camera> camera = Error{};
};

/// The bound counts differences, and no place in the grid: rounding them with
/// the place, or a bound 2^9 times smaller, fails.
TEST(ShadeBounds, OfGradientsOfWhatIsSmallOnAFineGrid) {
  Random random;
  double largest = 0;
  std::size_t told = 0;
  std::size_t sharp = 0;
  for (int round = 0; round < 4500; ++round) {
    const int bits = kGridBits[round % 3];
    const NearShot shot(random, bits);
    if (!shot.scene || !shot.camera) continue;
    const View view = make_view(*shot.camera, bits);
    GouraudShader shader(*shot.scene, shot.camera->data(), view);
    const int i = round % 64;
    const int j = 63 - i;
    shader.start(0, 1);
    const Gradient& g = shader.gradient();
    const auto at = [&](std::size_t f) {
      return g.a[f] * i + (g.b[f] * j + g.c[f]);
    };
    const double total = at(3);
    const double doubt = g.doubt / std::abs(total);
    if (!(doubt < 0.25)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const double level = at(c) / total;
      if (!(std::abs(level) <= 256)) continue;
      ++told;
      sharp += doubt < 0x1p-20 ? 1 : 0;
      const BigRational off = shader.exact_value(c, i, j) - exact_double(level);
      const auto share = static_cast<double>(off) / doubt;
      ASSERT_LE(std::abs(share), 1) << bits << " bits, round " << round;
      largest = std::max(largest, std::abs(share));
    }
  }
  EXPECT_GT(told, 2000u);
  EXPECT_GT(10 * sharp, 9 * told);
  EXPECT_GT(largest, 0x1p-9);
}

/// A triangle of a block with smooth colours; tells whether it was asked for
/// them.
struct SmallAsked : NoFallback {
  PixelSource begin(std::int32_t, std::int32_t) override {
    view->corner_colors = colors.data();
    return {0, PixelSource::kSmooth, 1, 0};
  }
  const Gradient& gradient() override {
    is_asked = true;
    return NoFallback::gradient();
  }
  TileView* view = nullptr;
  std::array<std::uint8_t, 9> colors{};
  bool is_asked = false;
};

/// A corner as a camera sees it that divides x and y by t.
struct SeenCorner {
  Long x, y, t;
};
using SeenTriangle = std::array<SeenCorner, 3>;

/// The channels at (x, y) of a triangle that covers it; none where it does not.
std::vector<Long> levels_within(const SeenTriangle& corners,
                                const std::array<std::uint8_t, 9>& colors,
                                Long x, Long y) {
  std::array<Long, 3> weight;
  Long total = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const SeenCorner& p = corners[(k + 1) % 3];
    const SeenCorner& q = corners[(k + 2) % 3];
    weight[k] = ((q.x / q.t - p.x / p.t) * (y - p.y / p.t) -
                 (q.y / q.t - p.y / p.t) * (x - p.x / p.t)) /
                corners[k].t;
    total += weight[k];
  }
  std::vector<Long> levels(3);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(weight[k] / total > 0)) return {};
    for (std::size_t c = 0; c < 3; ++c) {
      levels[c] += weight[k] * colors[3 * k + c] / total;
    }
  }
  return levels;
}

/// Small triangles whose colours come from their corners in the image, which
/// are off by what the view says, or hardly: a bound 2^12 times smaller fails.
TEST(ShadeBounds, OfGradientsFromCornersInTheImage) {
  for (const SimdLevel level : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    const TileKernel& kernel = best_kernel(level);
    if (!is_supported(level)) continue;
    Random random;
    std::size_t told = 0;
    std::array<double, 2> largest{};
    for (int round = 0; round < 20'000; ++round) {
      const bool is_off = round % 2 != 0;
      View view;
      view.perspective = round % 4 < 2;
      view.x.a = view.y.b = view.t.c = 1;
      view.near = view.perspective ? 0 : -1e300;
      const double depth = view.perspective ? random.from_to(1, 900) : 1;
      view.xy_error = is_off ? 0x1p-21 * depth : 0;
      view.t_error = is_off && view.perspective ? 0x1p-28 * depth : 0;

      SmallAsked asked;
      for (std::uint8_t& c : asked.colors) {
        c = static_cast<std::uint8_t>(random.from_to(0, 256));
      }
      FragmentBlock<3> block;
      block.count = 1;
      SeenTriangle corners;
      for (std::size_t c = 0; c < 3; ++c) {
        // Close together in depth, or not.
        const auto t = static_cast<float>(
            view.perspective ? depth * random.from_to(0.9, 1.1) : 1);
        const auto x = static_cast<float>(t * random.from_to(0, 60));
        const auto y = static_cast<float>(t * random.from_to(0, 18));
        block.x[c].fill(x);
        block.y[c].fill(y);
        block.z[c].fill(t);
        corners[c] = {x, y, t};
      }
      Rendering result;
      result.colors = ColorImage(kSampleWidth, kSampleHeight, Rgb{});
      TileBuffer buffer({0, 0, kSampleWidth, kSampleHeight}, {0, kSampleHeight},
                        result, false);
      asked.view = &buffer.view();
      buffer.view().exact = &asked;
      kernel.draw_triangles(buffer.view(), view, false, block);
      if (buffer.view().source_count == 0 || asked.is_asked) continue;
      const Gradient& g = buffer.view().gradients[0];
      for (int way = 0; way < (is_off ? 4 : 1); ++way) {
        SeenTriangle truth = corners;
        for (SeenCorner& corner : truth) {
          const auto off = [&](double by) {
            return by * (random.from_to(0, 1) < 0.5 ? -0.99 : 0.99);
          };
          corner.x += off(view.xy_error);
          corner.y += off(view.xy_error);
          corner.t += off(view.t_error);
        }
        for (std::int32_t j = 0; j < kSampleHeight; j += 2) {
          for (std::int32_t i = 0; i < 64; i += 3) {
            const std::vector<Long> levels =
                levels_within(truth, asked.colors, i + 0.5L, j + 0.5L);
            for (std::size_t c = 0; c < levels.size(); ++c) {
              const auto at = [&](std::size_t f) {
                return g.a[f] * i + (g.b[f] * j + g.c[f]);
              };
              const double share =
                  static_cast<double>(std::abs(at(c) / at(3) - levels[c])) *
                  at(3) / g.doubt;
              ASSERT_LE(share, 1) << "round " << round;
              largest[is_off ? 1 : 0] =
                  std::max(largest[is_off ? 1 : 0], share);
              ++told;
            }
          }
        }
      }
    }
    EXPECT_GT(told, 100'000u);
    EXPECT_GT(largest[0], 0x1p-12);
    EXPECT_GT(largest[1], 0x1p-10);
  }
}

}  // namespace
}  // namespace halfspace::fast
