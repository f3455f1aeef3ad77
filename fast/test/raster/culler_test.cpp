#include "raster/culler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "noisy.hpp"
#include "raster/tile_buffer.hpp"

/// Which boxes are skipped: none that holds what an unlit pixel's centre sees,
/// were it at the box's very border; but what is well away from all those.
namespace halfspace::fast {
namespace {

constexpr int kBits = 26;
constexpr double kGrid = 1 << 25;
constexpr std::int32_t kHeight = 60;

/// The pixels that are wanted, and those of them that are lit: on the left or,
/// where floats can tell few pixels apart, far on the right.
struct Pixels {
  explicit Pixels(std::int32_t first)
      : left(first),
        wanted{first + 13, 7, first + 87, 51},
        lit{first + 20, 10, first + 70, 45} {}
  std::int32_t left;
  Rectangle wanted;
  Rectangle lit;
};

bool is_in(const Rectangle& r, std::int32_t i, std::int32_t j) {
  return r.left <= i && i < r.right && r.top <= j && j < r.bottom;
}

/// A camera that sees a good part of the grid, not quite along its axes.
CameraData camera_data(Random& random, bool perspective, std::int32_t left) {
  const auto way = static_cast<int>(random.from_to(0, 24));
  const auto vector = [&](double x, double y, double z, double size) {
    double v[3] = {x, y, z};
    for (int a = 0; a < 3; ++a) {
      v[a] = (v[a] + random.from_to(-0.2, 0.2)) * 256 * size;
      if ((way >> a & 1) != 0) v[a] = -v[a];
    }
    std::rotate(v, v + way / 8, v + 3);
    return LatticeVector{static_cast<Int128>(v[0]), static_cast<Int128>(v[1]),
                         static_cast<Int128>(v[2])};
  };
  CameraData data;
  data.perspective = perspective;
  data.width_px = left + 100;
  data.height_px = kHeight;
  data.sx = vector(1, 0, 0, perspective ? 0x1p14 : 0x1p18);
  data.sy = vector(0, -1, 0, perspective ? 0x1p14 : 0x1p18);
  const LatticeVector away = vector(0, 0, 1, 0x1p21);
  const LatticeVector from = vector(0, 0, -1, 0x1p25);
  const auto first = [&](auto of) {
    return from.*of - (left + 50) * data.sx.*of - 30 * data.sy.*of;
  };
  data.s0 = {first(&LatticeVector::x), first(&LatticeVector::y),
             first(&LatticeVector::z)};
  data.eye = {-away.x, -away.y, -away.z};
  if (perspective) {
    data.eye = from;
    data.s0 = {data.s0.x + away.x, data.s0.y + away.y, data.s0.z + away.z};
  }
  if (random.from_to(0, 3) < 1) data.near = 8 << kNearBits;
  return data;
}

/// A box with the point in it, often at its border.
Box box_around(Random& random, const std::array<double, 3>& p) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  Box box;
  const double size = std::exp2(random.from_to(0, 24));
  for (std::size_t a = 0; a < 3; ++a) {
    const auto away = [&] {
      return std::max(0.0, random.from_to(-0.5, 1)) * size;
    };
    box.low[a] = std::nextafter(static_cast<float>(p[a] - away()), -kFar);
    box.high[a] = std::nextafter(static_cast<float>(p[a] + away()), kFar);
  }
  return box;
}

/// Where a box is seen, by its corners.
struct Seen {
  Seen(const View& view, const Box& box) {
    for (int k = 0; k < 8; ++k) {
      const auto end = [&](std::size_t a) {
        return double{(k >> a & 1) != 0 ? box.high[a] : box.low[a]};
      };
      const double depth = view.t.at(end(0), end(1), end(2));
      const double over = view.perspective ? depth : 1;
      t = {std::min(t[0], depth), std::max(t[1], depth)};
      const double i = view.x.at(end(0), end(1), end(2)) / over;
      const double j = view.y.at(end(0), end(1), end(2)) / over;
      x = {std::min(x[0], i), std::max(x[1], i)};
      y = {std::min(y[0], j), std::max(y[1], j)};
    }
  }

  bool is_behind(const View& view) const { return t[1] < view.near - 0.01; }
  /// Whether it is in front of the eye, and a pixel away from the unlit ones.
  bool is_aside(const View& view, const Pixels& pixels) const {
    const auto& [left, wanted, lit] = pixels;
    if (view.perspective && !(t[0] > 0.5 && t[0] > 0.01 * t[1])) return false;
    return x[1] < wanted.left - 1 || x[0] > wanted.right + 1 ||
           y[1] < wanted.top - 1 || y[0] > wanted.bottom + 1 ||
           (x[0] > lit.left + 1 && x[1] < lit.right - 1 && y[0] > lit.top + 1 &&
            y[1] < lit.bottom - 1);
  }

  static constexpr double kMost = std::numeric_limits<double>::infinity();
  std::array<double, 2> t = {kMost, -kMost};
  std::array<double, 2> x = {kMost, -kMost};
  std::array<double, 2> y = {kMost, -kMost};
};

void light(const TileKernel& kernel, TileView& screen, const Rectangle& r) {
  const double x[4] = {double(r.left), double(r.right), double(r.right),
                       double(r.left)};
  const double y[4] = {double(r.top), double(r.top), double(r.bottom),
                       double(r.bottom)};
  kernel.draw(screen, {x, y, 4, 0x1p-20, 1}, {0, 0, 1, 0});
}

/// The point that the pixel's centre sees at depth `t`.
std::array<double, 3> point_seen(const CameraData& data, std::int32_t i,
                                 std::int32_t j, double t) {
  const auto along = [&](auto of) {
    const auto steps = [of](const LatticeVector& v) {
      return static_cast<double>(v.*of) / 256;
    };
    const double s = steps(data.s0) + (i + 0.5) * steps(data.sx) +
                     (j + 0.5) * steps(data.sy);
    const double eye = steps(data.eye);
    return data.perspective ? eye + t * (s - eye) : s - t * eye;
  };
  return {along(&LatticeVector::x), along(&LatticeVector::y),
          along(&LatticeVector::z)};
}

void expect_sight(const TileKernel& kernel, bool perspective,
                  const Pixels& pixels) {
  const auto& [left, wanted, lit] = pixels;
  Random random;
  Rendering none;
  TileBuffer buffer(wanted, {wanted.top, wanted.bottom}, none, false);
  light(kernel, buffer.view(), lit);
  std::size_t seen = 0, behind = 0, aside = 0;
  for (int round = 0; round < 20'000; ++round) {
    const CameraData data = camera_data(random, perspective, left);
    const View view = make_view(*make_camera(data, kBits), kBits);
    const Culler culler(view, kernel, buffer.view());
    // Often in the first or the last column or row that is wanted.
    const auto place = [&](int first, int end, int size) {
      const auto somewhere = static_cast<std::int32_t>(random.from_to(0, size));
      const double which = random.from_to(0, 4);
      return which < 1 ? first : which < 2 ? end - 1 : somewhere;
    };
    const std::int32_t i = left + place(13, 87, 100);
    const std::int32_t j = place(7, 51, kHeight);
    const double t = random.from_to(0, 2) < 1
                         ? random.from_to(-1, 32)
                         : std::exp2(random.from_to(-8, 5));
    const std::array<double, 3> p = point_seen(data, i, j, t);
    const Box box = box_around(random, p);
    if (std::max({-box.low[0], -box.low[1], -box.low[2], box.high[0],
                  box.high[1], box.high[2]}) > kGrid) {
      continue;
    }
    const bool can_show = culler.can_show(box);
    const Seen where(view, box);
    if (t > view.near + 1e-6 && is_in(wanted, i, j) && !is_in(lit, i, j)) {
      ASSERT_TRUE(can_show) << round;
      ++seen;
    } else if (where.is_behind(view)) {
      ASSERT_FALSE(can_show) << round;
      ++behind;
    } else if (where.is_aside(view, pixels)) {
      ASSERT_FALSE(can_show) << round;
      ++aside;
    }
  }
  EXPECT_GT(seen, 1000u);
  EXPECT_GT(behind, 100u);
  EXPECT_GT(aside, 1000u);
}

TEST(Culler, SkipsNoBoxWithAPointThatIsSeenButThoseAway) {
  for (const TileKernel* kernel :
       {&kPortableKernel, &best_kernel(SimdLevel::kAvx2), &best_kernel()}) {
    expect_sight(*kernel, true, Pixels(0));
    expect_sight(*kernel, true, Pixels(60'000));
    expect_sight(*kernel, false, Pixels(0));
    if (HasFatalFailure()) return;
  }
}

/// Pixels of a step on the widest grid: doubles cannot tell where they are.
TEST(Culler, SkipsNothingThatDoublesAreTooCoarseFor) {
  CameraData data;
  data.sx = {256, 0, 0};
  data.sy = {0, 256, 0};
  data.width_px = data.height_px = 8;
  Rendering none;
  TileBuffer buffer({0, 0, 8, 8}, {0, 8}, none, false);
  const auto can_show = [&](float side, float depth) {
    const View view = make_view(*make_camera(data, 54), 54);
    // A box well beyond the image.
    return Culler(view, best_kernel(), buffer.view())
        .can_show({{side, side, depth}, {side + 1e3f, side + 1e3f, depth}});
  };
  // Not even how deep the box is.
  data.s0 = {0, 0, 256};
  EXPECT_TRUE(can_show(1e6f, 1e4f));
  EXPECT_FALSE(can_show(1e12f, 1e9f));
  data.s0 = {0, 0, 1 << 28};
  EXPECT_TRUE(can_show(1e6f, 0x1p20f * 100));
  EXPECT_FALSE(can_show(1e8f, 0x1p20f * 1e4f));
  data.perspective = false;
  data.eye = {0, 0, 256};
  EXPECT_TRUE(can_show(1e6f, 1));
}

}  // namespace
}  // namespace halfspace::fast
