#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "camera/view.hpp"
#include "cases.hpp"
#include "no_fallback.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "raster/tile_buffer.hpp"

/// The kernels are given outlines with errors so large that it matters: moved
/// by them, corners change what is covered. Where they do, a kernel must ask;
/// where it does not ask, no such move may change what it drew.
namespace halfspace::fast {
namespace {

constexpr std::int32_t kWidth = 100;
constexpr std::int32_t kHeight = 60;

struct Point {
  double x;
  double y;
};
using Polygon = std::vector<Point>;

/// The first pixel whose centre is not below `v`.
std::int32_t first_centre_from(double v) {
  return static_cast<std::int32_t>(std::ceil(v - 0.5));
}

/// What a convex polygon covers of a line, within the image.
PixelRange covered(const Polygon& p, std::int32_t j) {
  const double y = j + 0.5;
  double left = 1e9;
  double right = -1e9;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Point& a = p[k];
    const Point& b = p[(k + 1) % p.size()];
    if ((a.y > y) == (b.y > y)) continue;
    const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    left = std::min(left, x);
    right = std::max(right, x);
  }
  if (left > right) return {0, 0};
  const std::int32_t first = std::clamp(first_centre_from(left), 0, kWidth);
  const std::int32_t end = std::clamp(first_centre_from(right), 0, kWidth);
  return first < end ? PixelRange{first, end} : PixelRange{0, 0};
}

double turn_at(const Polygon& p, std::size_t k) {
  const Point& a = p[k];
  const Point& b = p[(k + 1) % p.size()];
  const Point& c = p[(k + 2) % p.size()];
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_convex(const Polygon& p) {
  for (std::size_t k = 1; k < p.size(); ++k) {
    if ((turn_at(p, k) > 0) != (turn_at(p, 0) > 0)) return false;
  }
  return true;
}

/// In how many ways a polygon is moved.
int ways(const Polygon& p) { return 1 << (2 * p.size()); }

/// The polygon with each corner moved to a corner of the square around it.
Polygon moved(Polygon p, double by, int way) {
  for (Point& corner : p) {
    corner.x += (way & 1) != 0 ? by : -by;
    corner.y += (way & 2) != 0 ? by : -by;
    way >>= 2;
  }
  return p;
}

/// What a kernel asked for.
struct Asked : NoFallback {
  PixelSource begin(std::int32_t, std::int32_t) override { return source; }
  PixelRange exact_line(std::int32_t j, PixelRange) override {
    lines[static_cast<std::size_t>(j)] = true;
    return {0, 0};
  }
  std::vector<bool> lines = std::vector<bool>(kHeight);
  PixelSource source;
};

constexpr PixelSource kBlank = {kBackground, 0, 0, 0};

/// A blank image with its screen.
struct Paper {
  Paper() {
    result.items = ItemImage(kWidth, kHeight, kBackground);
    buffer.emplace(Rectangle{0, 0, kWidth, kHeight}, PixelRange{0, kHeight},
                   result, false);
  }
  TileView& view() { return buffer->view(); }
  Rendering result;
  std::optional<TileBuffer> buffer;
};

/// What the polygon may be in truth: its corners are off, but it is convex.
template <class Moved>
std::vector<Polygon> truths(const Polygon& p, double error, Moved moved) {
  std::vector<Polygon> result;
  for (int way = 0; way < ways(p); ++way) {
    const Polygon other = moved(p, 0.99 * error, way);
    if (is_convex(other)) result.push_back(other);
  }
  return result;
}

/// Compares an image, but for lines that were asked for, with all of these.
void expect_told(const std::vector<Polygon>& truths, const Asked& asked,
                 const ItemImage& items, std::size_t& changed) {
  for (std::int32_t j = 0; j < kHeight; ++j) {
    const PixelRange here = covered(truths[0], j);
    bool may_change = false;
    for (const Polygon& truth : truths) {
      const PixelRange there = covered(truth, j);
      may_change =
          may_change || there.first != here.first || there.end != here.end;
    }
    changed += may_change ? 1 : 0;
    if (asked.lines[static_cast<std::size_t>(j)]) continue;
    ASSERT_FALSE(may_change) << "line " << j;
    for (std::int32_t i = 0; i < kWidth; ++i) {
      ASSERT_EQ(items.at(i, j) != kBackground, here.first <= i && i < here.end)
          << i << ", " << j;
    }
  }
}

class Random {
 public:
  double from_to(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Point point() { return {from_to(-5, kWidth + 5), from_to(-5, kHeight + 5)}; }
  /// Corners around a common point; one in three with a flat edge, one with an
  /// edge that passes closely by a pixel's centre.
  Polygon triangle(double size, double error) {
    const Point middle = point();
    Polygon p(3);
    for (Point& corner : p) {
      corner = {middle.x + from_to(-size, size),
                middle.y + from_to(-size, size)};
    }
    const double kind = from_to(0, 3);
    if (kind < 1) {
      p[1].y = p[0].y + from_to(-0.02, 0.02);
    } else if (kind < 2) {
      const Point centre = {std::floor(middle.x) + 0.5,
                            std::floor(middle.y) + 0.5};
      const double t = from_to(-3, 3);
      p[2].x = centre.x + t * (centre.x - p[1].x) + from_to(-2, 2) * error;
      p[2].y = centre.y + t * (centre.y - p[1].y);
    }
    return p;
  }
  /// A short edge that a long one goes on, nearly straight: the line of the
  /// short one is known badly where the long one bounds. As its corners are off
  /// it need not be convex.
  Polygon quadrangle(double size, double error) {
    while (true) {
      const Point a = point();
      const Point d = {a.x + from_to(-size, size), a.y + from_to(-size, size)};
      const double share = from_to(0.004, 0.1);
      const Point b = {a.x + share * (d.x - a.x), a.y + share * (d.y - a.y)};
      // Across, by as much as the errors of the short edge may seem to bend it.
      const double bend =
          from_to(-2, 2) * error / share / std::hypot(d.x - a.x, d.y - a.y);
      const Polygon p = {a,
                         b,
                         {d.x + bend * (d.y - a.y), d.y - bend * (d.x - a.x)},
                         {a.x + from_to(-size, size), from_to(a.y, d.y)}};
      if (std::abs(turn_at(p, 2)) > size) return p;
    }
  }

 private:
  std::mt19937_64 engine_{7};
};

const TileKernel* const kKernels[] = {
    &kPortableKernel, &best_kernel(SimdLevel::kAvx2), &best_kernel()};

TEST(KernelBounds, OutlinesAskWhereTheirErrorMatters) {
  for (const TileKernel* kernel : kKernels) {
    Random random;
    std::size_t changed = 0;
    for (int round = 0; round < 2000; ++round) {
      const double error = random.from_to(0x1p-11, 0x1p-10);
      const Polygon p = round % 4 == 0 ? random.triangle(40, error)
                                       : random.quadrangle(40, error);
      const std::vector<Polygon> all = truths(p, error, moved);
      const double turn = turn_at(p, p.size() - 2);
      if (all.empty() || std::abs(turn) < 1) continue;
      std::array<double, 4> x{};
      std::array<double, 4> y{};
      for (std::size_t k = 0; k < p.size(); ++k) {
        x[k] = p[k].x;
        y[k] = p[k].y;
      }
      Asked asked;
      Paper paper;
      paper.view().exact = &asked;
      kernel->draw(paper.view(),
                   {x.data(), y.data(), static_cast<std::int32_t>(p.size()),
                    error, turn > 0 ? 1 : -1},
                   asked.source);
      kernel->fill_rest(paper.view(), kBlank);
      expect_told(all, asked, paper.result.items, changed);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(changed, 150u);
  }
}

/// A view of points as they are.
View plain_view() {
  View view;
  view.perspective = false;
  view.x.a = view.y.b = view.t.c = 1;
  view.near = -std::numeric_limits<double>::infinity();
  view.xy_growth = 1;
  return view;
}

/// Where the error comes from.
enum class Off { kView, kBlock, kDepth };
constexpr std::array<Off, 3> kOffs = {Off::kView, Off::kBlock, Off::kDepth};

/// By so much less corners are off if depths are by as much: these are at most
/// so far from the image's first corner.
constexpr float kDepthShare = 1.0f / (kWidth + 40);

/// The polygon with each corner moved to or from the image's first corner.
Polygon moved_in_depth(Polygon p, double by, int way) {
  for (Point& corner : p) {
    const double factor = (way & 1) != 0 ? 1 + by : 1 - by;
    corner = {factor * corner.x, factor * corner.y};
    way >>= 1;
  }
  return p;
}

/// What came of drawing one polygon together with others.
struct Small {
  Asked asked;
  Paper paper;
  bool is_left = false;
  std::int64_t displayed = 0;
};

template <std::size_t kCorners>
BlockDrawn draw_block(const Polygon& p, View view, float error, Off off,
                      bool cull, Small& to) {
  FragmentBlock<kCorners> block;
  for (std::size_t c = 0; c < kCorners; ++c) {
    block.x[c].fill(static_cast<float>(p[c].x));
    block.y[c].fill(static_cast<float>(p[c].y));
    block.z[c].fill(1);
  }
  block.count = 1;
  switch (off) {
    case Off::kView:
      view.xy_error = error;
      break;
    case Off::kBlock:
      block.error.fill(error);
      break;
    case Off::kDepth:
      view.perspective = true;
      view.near = 0;
      view.t_error = error * kDepthShare;
  }
  const auto draw = [] {
    if constexpr (kCorners == 3) {
      return best_kernel().draw_triangles;
    } else {
      return best_kernel().draw_quadrangles;
    }
  }();
  to.paper.view().exact = &to.asked;
  return draw(to.paper.view(), view, cull, block);
}

std::unique_ptr<Small> draw_small(const Polygon& p, const View& view,
                                  float error, Off off, bool cull) {
  auto result = std::make_unique<Small>();
  const BlockDrawn drawn =
      p.size() == 3 ? draw_block<3>(p, view, error, off, cull, *result)
                    : draw_block<4>(p, view, error, off, cull, *result);
  result->displayed = drawn.displayed;
  best_kernel().fill_rest(result->paper.view(), kBlank);
  result->is_left = drawn.left != 0;
  return result;
}

/// The polygon with corners that floats hold.
Polygon in_floats(Polygon p) {
  for (auto& corner : p) {
    corner = {static_cast<float>(corner.x), static_cast<float>(corner.y)};
  }
  return p;
}

TEST(KernelBounds, SmallPolygonsAskWhereTheirErrorMatters) {
  Random random;
  std::size_t changed = 0;
  std::size_t drawn = 0;
  for (std::uint64_t round = 0; round < cases(8000); ++round) {
    const auto error = static_cast<float>(random.from_to(0x1p-11, 0x1.fp-11));
    const Polygon p = in_floats(round % 4 == 0 ? random.triangle(25, error)
                                               : random.quadrangle(30, error));
    const Off off = kOffs[round / 4 % 3];
    const auto found = draw_small(p, plain_view(), error, off, false);
    // What it leaves undone is done by others; a part may be drawn by then.
    if (found->is_left) continue;
    const std::vector<Polygon> all =
        off == Off::kDepth ? truths(p, error * kDepthShare, moved_in_depth)
                           : truths(p, error, moved);
    if (all.empty()) continue;
    ++drawn;
    expect_told(all, found->asked, found->paper.result.items, changed);
    if (HasFatalFailure()) return;
  }
  if (&best_kernel() != &kPortableKernel) {
    EXPECT_GT(drawn, cases(2000));
  }
}

/// Triangles so thin that their corners' errors turn them over.
TEST(KernelBounds, SmallPolygonsTurnForSureOrAreLeft) {
  Random random;
  std::size_t told = 0;
  for (int round = 0; round < 8000; ++round) {
    const auto error = static_cast<float>(random.from_to(0x1p-12, 0x1.fp-11));
    Polygon p = random.triangle(20, error);
    // The third corner moves to the line through the others, nearly.
    const double t = random.from_to(-0.5, 1.5);
    p[2] = {p[0].x + t * (p[1].x - p[0].x) + random.from_to(-24, 24) * error,
            p[0].y + t * (p[1].y - p[0].y) + random.from_to(-24, 24) * error};
    p = in_floats(p);
    bool positive = false;
    bool negative = false;
    for (int way = 0; way < ways(p); ++way) {
      const double turn = turn_at(moved(p, 0.99 * error, way), 0);
      positive = positive || turn > 0;
      negative = negative || turn < 0;
    }
    // Culling keeps those of them that turn negatively.
    const auto found =
        draw_small(p, plain_view(), error,
                   round % 2 == 0 ? Off::kView : Off::kBlock, true);
    if (found->is_left) continue;
    ASSERT_FALSE(positive && negative);
    ASSERT_EQ(found->displayed, negative ? 1 : 0);
    ++told;
  }
  if (&best_kernel() != &kPortableKernel) {
    EXPECT_GT(told, 500u);
  }
}

/// What is small may still be too near for its depth's error.
TEST(KernelBounds, SmallPolygonsAreLeftWhereTheirDepthIsInDoubt) {
  const Polygon p = {{0.25, 0.25}, {0.875, 0.25}, {0.5, 0.875}};
  View view = plain_view();
  view.perspective = true;
  view.near = 0;
  for (const Off off : {Off::kView, Off::kBlock}) {
    double& doubt = off == Off::kView ? view.t_error : view.t_growth;
    doubt = off == Off::kView ? 0x1p-12 : 0x1p8;
    const bool is_plain = &best_kernel() == &kPortableKernel;
    EXPECT_EQ(draw_small(p, view, 0x1p-20f, off, false)->is_left, is_plain);
    doubt *= 3;
    EXPECT_TRUE(draw_small(p, view, 0x1p-20f, off, false)->is_left);
    doubt = 0;
  }
}

/// Rectangles against screens with few open tiles, several words wide.
TEST(KernelBounds, ARectangleIsOpenWhereATileOfItIs) {
  constexpr std::int32_t kTiles = 250;
  constexpr std::int32_t kRows = 4;
  std::mt19937_64 engine(13);
  const auto below = [&engine](std::int32_t end) {
    return static_cast<std::int32_t>(engine() %
                                     static_cast<std::uint64_t>(end));
  };
  std::size_t found = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::vector<std::uint64_t> open(4 * kRows);
    TileView screen;
    screen.first_row = 3;
    screen.words_across = 4;
    screen.open = open.data();
    const std::int32_t tile = below(kTiles);
    const std::int32_t row = below(kRows);
    open[static_cast<std::size_t>(4 * row + tile / 64)] |= std::uint64_t{1}
                                                           << (tile % 64);
    const std::int32_t left = below(kTiles * kTileWidth);
    const std::int32_t right = left + 1 + below(kTiles * kTileWidth - left);
    const std::int32_t first = 3 * kTileHeight;
    const std::int32_t top = below(kRows * kTileHeight);
    const std::int32_t bottom = top + 1 + below(kRows * kTileHeight - top);
    const bool expected =
        left / kTileWidth <= tile && tile <= (right - 1) / kTileWidth &&
        top / kTileHeight <= row && row <= (bottom - 1) / kTileHeight;
    for (const TileKernel* kernel : kKernels) {
      ASSERT_EQ(kernel->any_open(screen, {left, right},
                                 {first + top, first + bottom}),
                expected);
    }
    found += expected ? 1 : 0;
  }
  EXPECT_GT(found, 1000u);
}

}  // namespace
}  // namespace halfspace::fast
