#include "halfspace/fast/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "halfspace/fast/build.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/painter.hpp"
#include "scenes.hpp"
#include "tree/leaf_packets.hpp"
#include "tree/node_boxes.hpp"

namespace halfspace::fast {
namespace {

constexpr std::int64_t kDepth = 1'000'000;
constexpr std::int32_t kCount = 8;
constexpr std::int64_t kLast = kDepth + 3;  ///< the last depth that is not seen

/// Triangles side by side, each a grid step farther away than the one before.
Scene side_by_side() {
  SceneData data;
  for (std::int64_t k = 0; k < kCount; ++k) {
    const std::int64_t x = (8 * k - 32) * kDepth / 64;
    const std::int64_t width = 8 * kDepth / 64;
    add_polygon(data, {{x, -width, kDepth + k},
                       {x + width, 0, kDepth + k},
                       {x, width, kDepth + k}});
  }
  return made(std::move(data));
}

CameraData camera_of(std::int64_t size, std::int64_t depth) {
  CameraData data;
  data.s0 = {-32 * size, -32 * size, depth * 256};
  data.sx = {size, 0, 0};
  data.sy = {0, size, 0};
  data.width_px = data.height_px = 64;
  return data;
}

/// Image points at 2^16: near is a depth.
Camera perspective() {
  CameraData data = camera_of(65536 * 256 / 64, 65536);
  data.near = kLast;
  return *make_camera(data, 26);
}

Camera orthographic() {
  constexpr std::int64_t kBefore = 60'000;
  CameraData data = camera_of(kDepth * 256 / 64, kDepth - kBefore);
  data.perspective = false;
  data.eye = {0, 0, -256};
  data.near = (kBefore + kLast - kDepth) << kNearBits;
  return *make_camera(data, 26);
}

/// All in one leaf, to be drawn together.
BspTree one_leaf() {
  BspTree tree;
  Node leaf;
  leaf.first_fragment = 0;
  tree.nodes.push_back(leaf);
  for (std::int32_t k = 0; k < kCount; ++k) {
    const std::int32_t next = k + 1 < kCount ? k + 1 : kNoFragment;
    tree.fragments.push_back(
        {k, static_cast<std::uint32_t>(3 * k), 3, 0, next});
    for (std::int32_t c = 0; c < 3; ++c) tree.corners.push_back({c, 3 * k + c});
  }
  return tree;
}

void expect_those_beyond(const ItemImage& items) {
  for (std::int32_t k = 0; k < kCount; ++k) {
    EXPECT_EQ(items.at(8 * k + 2, 32), kDepth + k > kLast ? k : kBackground);
  }
}

TEST(Near, WhatIsAStepBeyondIsSeen) {
  const Scene scene = side_by_side();
  const BspTree tree = build(scene, {});
  const BspTree leaf = one_leaf();
  BspTree blocks = leaf;
  add_blocks(blocks, scene);
  for (const Camera& camera : {perspective(), orthographic()}) {
    for (const SimdLevel level :
         {SimdLevel::kBest, SimdLevel::kAvx2, SimdLevel::kPortable}) {
      RenderOptions options;
      options.simd = level;
      for (const BspTree* each : {&tree, &leaf, &std::as_const(blocks)}) {
        expect_those_beyond(render(scene, *each, camera, {}, options).items);
      }
      expect_those_beyond(paint(scene, tree, camera, {}, options).items);
    }
  }
}

TEST(FastRender, PixelsAreCountedWithoutImages) {
  const Scene scene = side_by_side();
  const BspTree tree = build(scene, {});
  const BspTree leaf = one_leaf();
  BspTree blocks = leaf;
  add_blocks(blocks, scene);
  RenderOptions counted;
  counted.items = counted.colors = false;
  for (const SimdLevel level :
       {SimdLevel::kBest, SimdLevel::kAvx2, SimdLevel::kPortable}) {
    counted.simd = level;
    for (const BspTree* each : {&tree, &leaf, &std::as_const(blocks)}) {
      const Rendering all = render(scene, *each, perspective(), {}, {});
      EXPECT_GT(all.pixels_painted, 0U);
      EXPECT_EQ(render(scene, *each, perspective(), {}, counted).pixels_painted,
                all.pixels_painted);
    }
  }
}

// The centre sees 1/2 - start / (2^38 + 2^8) of the second corner's colour.
TEST(FastRender, AColorIsNotRoundedUpAHairBelowAHalf) {
  SceneData data;
  add_polygon(data, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  data.corner_colors = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  const Scene scene = made(std::move(data));
  for (const int start : {-1, 0, 1}) {
    CameraData camera;
    camera.perspective = false;
    camera.eye = {1, 0, (1 << 30) + 1};
    camera.s0 = {0, 0, start};
    camera.sx = {256, 0, 0};
    camera.sy = {0, 128, 0};
    camera.width_px = camera.height_px = 1;
    const Rendering image =
        render(scene, build(scene, {}), *make_camera(camera, 26),
               {.shading = Shading::kGouraud}, {});
    EXPECT_EQ(image.colors.at(0, 0).r, start > 0 ? 0 : 1) << start;
  }
}

// Two squares, one before the other, and a rectangle that begins and ends
// within the picture: counts are of this image, however it came about.
/// A surface of many small triangles about `centre`, each cell `step` wide.
Scene hills(int bits, const GridPoint& centre, std::int64_t step) {
  constexpr int kCells = 24;
  SceneData data;
  data.grid_bits = bits;
  const auto height = [step](int i, int j) {
    return (i * i + 3 * j) % 5 * step;
  };
  const auto point = [&](int i, int j) {
    return GridPoint{centre.x + (i - kCells / 2) * step,
                     centre.y + (j - kCells / 2) * step,
                     centre.z + height(i, j)};
  };
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      add_polygon(data, {point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      add_polygon(data, {point(i, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
  for (std::size_t k = 0; k < data.corners.size(); ++k) {
    const auto level = static_cast<std::uint8_t>(k * 37 % 256);
    data.corner_colors.push_back({level, 90, 255});
  }
  return made(std::move(data));
}

TEST(FastRender, BoundsCountTheBoxOfTheTree) {
  const GridPoint centre = {-5'000'000, 40, 1'000};
  const Scene scene = hills(54, centre, 1 << 12);
  BspTree tree = build_display_tree(scene);
  double most = 0;
  for (const GridPoint& p : scene.data().vertices) {
    for (const std::int64_t x : {p.x, p.y, p.z}) {
      most = std::max(most, std::abs(static_cast<double>(x)));
    }
  }
  const Extent extent = extent_of(tree, 54);
  EXPECT_GE(extent.most, most);
  EXPECT_LE(extent.most, most + 2);
  EXPECT_EQ(extent.grid, 0x1p53);
  tree.boxes.clear();
  EXPECT_EQ(extent_of(tree, 54).most, 0x1p53);
  EXPECT_EQ(extent_of(BspTree{}, 26).most, 0x1p25);
}

/// The same picture, wherever in the grid the scene is and however little of it
/// the scene takes; and hardly more integers for it.
TEST(FastRender, AFineGridCostsFewExactDecisions) {
  const auto draw = [](int bits, const GridPoint& centre, std::int64_t step) {
    const Scene scene = hills(bits, centre, step);
    CameraData seen;
    const auto at = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      return LatticeVector{Int128{centre.x} * 256 + Int128{x} * step,
                           Int128{centre.y} * 256 + Int128{y} * step,
                           Int128{centre.z} * 256 + Int128{z} * step};
    };
    seen.eye = at(1000, 700, -16000);
    seen.s0 = at(-3700, -3700, 0);
    seen.sx = {Int128{29} * step, 0, 0};
    seen.sy = {0, Int128{29} * step, 0};
    seen.width_px = seen.height_px = 256;
    const Result<Camera> camera = make_camera(seen, bits);
    EXPECT_TRUE(camera) << camera.error().message;
    ImageOptions look;
    look.shading = Shading::kGouraud;
    RenderOptions options;
    options.threads = 1;
    return render(scene, build_display_tree(scene), *camera, look, options);
  };
  constexpr std::int64_t kSmall = 1 << 12;
  const Rendering plain = draw(26, {}, kSmall);
  EXPECT_GT(plain.pixels_painted, 40'000u);
  const auto expect_same = [&](const Rendering& fine) {
    EXPECT_TRUE(fine.colors == plain.colors);
    // A thousandth of the pixels.
    EXPECT_LE(fine.decisions.exact, plain.decisions.exact + 65);
  };
  expect_same(draw(54, {}, kSmall));
  constexpr std::int64_t kFar = std::int64_t{1} << 51;
  expect_same(draw(54, {kFar, -kFar, kFar / 3}, std::int64_t{1} << 34));
}

TEST(FastRender, CountsWhatThisImageTook) {
  SceneData data;
  for (const std::int64_t depth : {kDepth, 2 * kDepth}) {
    add_polygon(data, {{-kDepth, -kDepth, depth},
                       {kDepth, -kDepth, depth},
                       {kDepth, kDepth, depth},
                       {-kDepth, kDepth, depth}});
  }
  const Scene scene = made(std::move(data));
  const BspTree tree = build(scene, {});
  const Camera camera = *make_camera(camera_of(65536 * 256 / 64, 65536), 26);
  RenderOptions part;
  part.rectangle = Rectangle{3, 5, 40, 61};
  const std::size_t pixels = 37 * 56;
  Rendering image = render(scene, tree, camera, {}, part);
  EXPECT_EQ(image.pixels_painted, pixels);
  EXPECT_EQ(image.fragments_displayed, 1u);
  render(scene, tree, camera, {}, part, image);
  EXPECT_EQ(image.pixels_painted, pixels);
  EXPECT_EQ(image.fragments_displayed, 1u);
  const FilterStats asked = image.decisions;
  EXPECT_GT(asked.filtered, 0u);
  render(scene, tree, camera, {}, part, image);
  EXPECT_TRUE(image.decisions == asked);
  for (const int threads : {2, 3}) {
    RenderOptions shared = part;
    shared.threads = threads;
    const Rendering other = render(scene, tree, camera, {}, shared);
    EXPECT_EQ(other.pixels_painted, pixels);
    EXPECT_TRUE(other.items == image.items);
    EXPECT_TRUE(other.colors == image.colors);
  }
  for (const bool items : {false, true}) {
    RenderOptions wanted;
    wanted.items = items;
    wanted.colors = !items;
    const Rendering one = render(scene, tree, camera, {}, wanted);
    EXPECT_EQ(one.items.pixels.empty(), !items);
    EXPECT_EQ(one.colors.pixels.empty(), items);
  }
  // The painter paints both.
  EXPECT_EQ(paint(scene, tree, camera, {}, part).pixels_painted, 2 * pixels);
  paint(scene, tree, camera, {}, part, image);
  EXPECT_EQ(image.pixels_painted, 2 * pixels);
  EXPECT_EQ(image.fragments_displayed, 2u);
}

/// Small triangles anywhere, many of them crossing, cut and in doubt: what one
/// leaves behind in a kernel changes the colours of the next.
TEST(FastRender, SmoothColorsAreTheSameByAllInstructions) {
  constexpr std::int64_t kSide = 1 << 22;
  std::mt19937_64 engine(5);
  const auto between = [&engine](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(engine);
  };
  SceneData data;
  for (int k = 0; k < 30'000; ++k) {
    const GridPoint middle = {between(-kSide, kSide), between(-kSide, kSide),
                              between(-kSide, kSide)};
    const auto corner = [&] {
      constexpr std::int64_t kReach = kSide / 40;
      return GridPoint{middle.x + between(-kReach, kReach),
                       middle.y + between(-kReach, kReach),
                       middle.z + between(-kReach, kReach)};
    };
    const auto color = [&] {
      const auto channel = [&] {
        return static_cast<std::uint8_t>(between(0, 255));
      };
      return Rgb{channel(), channel(), channel()};
    };
    add_polygon(data, {corner(), corner(), corner()}, color());
    for (int c = 0; c < 3; ++c) data.corner_colors.push_back(color());
  }
  const Scene scene = made(std::move(data));
  const BspTree tree = build_display_tree(scene);
  CameraData seen;
  seen.eye = {0, 0, -4 * 256 * kSide};
  seen.s0 = {-384 * kSide, -384 * kSide, 0};
  seen.sx = {kSide, 0, 0};
  seen.sy = {0, kSide, 0};
  seen.width_px = seen.height_px = 768;
  const Result<Camera> camera = make_camera(seen, 26);
  ASSERT_TRUE(camera) << camera.error().message;
  ImageOptions look;
  look.shading = Shading::kGouraud;
  const auto draw = [&](SimdLevel simd, bool items) {
    RenderOptions options;
    options.threads = 1;
    options.simd = simd;
    options.items = items;
    return render(scene, tree, *camera, look, options);
  };
  const Rendering plain = draw(SimdLevel::kPortable, true);
  EXPECT_GT(plain.pixels_painted, 200'000u);
  for (const SimdLevel simd : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    EXPECT_TRUE(draw(simd, false).colors == plain.colors);
    const Rendering both = draw(simd, true);
    EXPECT_TRUE(both.colors == plain.colors);
    EXPECT_TRUE(both.items == plain.items);
  }
  // Means of samples, of colours without items and of items with them.
  const auto draw_means = [&](SimdLevel simd, std::int32_t samples,
                              bool items) {
    RenderOptions options;
    options.threads = 1;
    options.simd = simd;
    options.items = items;
    options.rectangle = Rectangle{301, 303, 431, 420};
    return render_samples(scene, tree, *camera, look, samples, options);
  };
  for (const Shading shading : {Shading::kFlat, Shading::kGouraud}) {
    look.shading = shading;
    for (const std::int32_t samples : {2, 4, 8}) {
      const Rendering means = draw_means(SimdLevel::kPortable, samples, true);
      for (const SimdLevel simd :
           {SimdLevel::kPortable, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
        EXPECT_TRUE(draw_means(simd, samples, false).colors == means.colors);
        const Rendering both = draw_means(simd, samples, true);
        EXPECT_TRUE(both.colors == means.colors);
        EXPECT_TRUE(both.items == means.items);
      }
    }
  }
}

/// Polygons are remembered by the last bits of their ids: two that meet in a
/// pixel have the same ones here.
TEST(FastRender, PolygonsWithLikeIdsMeetInPixels) {
  constexpr std::int64_t kWide = 1 << 20;
  const auto draw = [](int between) {
    SceneData data;
    const auto add = [&](const std::array<GridPoint, 3>& corners, Rgb last) {
      add_polygon(data, {corners[0], corners[1], corners[2]});
      data.corner_colors.insert(data.corner_colors.end(),
                                {{250, 0, 10}, {0, 200, 30}, last});
    };
    add({{{-kWide, -kWide, 0}, {kWide, -kWide, 0}, {-kWide, kWide, 9}}},
        {7, 9, 255});
    for (int k = 0; k < between; ++k)
      add({{{0, 0, 1000}, {1, 0, 1000}, {0, 1, 1000}}}, {1, 2, 3});
    add({{{kWide, -kWide, 0}, {kWide, kWide, 5}, {-kWide, kWide, 9}}},
        {255, 0, 255});
    const Scene scene = made(std::move(data));
    CameraData seen;
    seen.eye = {0, 0, -4 * 256 * kWide / 100};
    seen.s0 = {-32 * 256 * 500, -32 * 256 * 500, seen.eye.z + 256 * kWide / 99};
    seen.sx = {256 * 500, 0, 0};
    seen.sy = {0, 256 * 500, 0};
    seen.width_px = seen.height_px = 64;
    ImageOptions look;
    look.shading = Shading::kGouraud;
    return render_samples(scene, build_display_tree(scene),
                          *make_camera(seen, 26), look, 4, {});
  };
  const Rendering two = draw(0);
  std::size_t mixed = 0;
  for (std::int32_t j = 0; j < 64; ++j) {
    for (std::int32_t i = 0; i < 64; ++i) {
      const PolygonId first = two.items.at(4 * i, 4 * j);
      const PolygonId last = two.items.at(4 * i + 3, 4 * j + 3);
      mixed += first == 0 && last == 1 ? 1 : 0;
    }
  }
  EXPECT_GE(mixed, 20u);
  EXPECT_TRUE(draw(1023).colors == two.colors);
}

/// All of an image of two tiles by two, by one fragment, and what is behind it.
TEST(FastRender, CountsTheTilesThatFragmentsTouch) {
  constexpr std::int64_t kWide = 1 << 20;
  SceneData data;
  for (const std::int64_t z : {0, 1000}) {
    add_polygon(data, {{-kWide, -kWide, z}, {kWide, -kWide, z}, {0, kWide, z}});
  }
  const Scene scene = made(std::move(data));
  CameraData seen;
  seen.perspective = false;
  seen.eye = {0, 0, -256};
  seen.s0 = {-32 * 256, -8 * 256, -256};
  seen.sx = {256, 0, 0};
  seen.sy = {0, 256, 0};
  seen.width_px = 64;
  seen.height_px = 16;
  const Result<Camera> camera = make_camera(seen, 26);
  ASSERT_TRUE(camera) << camera.error().message;
  const BspTree tree = build(scene, BuildOptions{});
  for (const SimdLevel simd : {SimdLevel::kPortable, SimdLevel::kBest}) {
    for (const int threads : {1, 2}) {
      RenderOptions options;
      options.simd = simd;
      options.threads = threads;
      EXPECT_EQ(render(scene, tree, *camera, {}, options).tiles_touched, 4u);
      EXPECT_EQ(paint(scene, tree, *camera, {}, options).tiles_touched, 8u);
    }
    RenderOptions options;
    options.simd = simd;
    // In a leaf the nearer of them goes over the other, or comes before it.
    const std::size_t touched =
        render(scene, build_display_tree(scene), *camera, {}, options)
            .tiles_touched;
    EXPECT_GE(touched, 4u);
    EXPECT_LE(touched, 8u);
  }
}

// What its screen takes is given back, and not kept for the next image.
TEST(FastRender, AnImageAfterAVeryLargeOneIsTheSame) {
  const Scene scene = side_by_side();
  const BspTree tree = build(scene, BuildOptions{});
  const ItemImage before = render(scene, tree, perspective(), {}, {}).items;
  CameraData data = camera_of(65536 * 256 / 64, 65536);
  data.width_px = data.height_px = 16384;
  RenderOptions only_counted;
  only_counted.items = only_counted.colors = false;
  render(scene, tree, *make_camera(data, 26), {}, only_counted);
  EXPECT_EQ(render(scene, tree, perspective(), {}, {}).items.pixels,
            before.pixels);
}

// Samples are decided in strips of rows, which share what is known of the caps.
TEST(FastRender, ACapInManyStripsIsThatOfEachOfThem) {
  constexpr std::int64_t kSize = 600'000;
  constexpr std::int32_t kPixels = 200;
  constexpr std::int32_t kRows = 16;  ///< of a strip, at 8 x 8 samples
  const auto corner = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return GridPoint{x * kSize, y * kSize, z * kSize + kDepth};
  };
  const GridPoint p = corner(1, 1, 1);
  const GridPoint q = corner(1, -1, -1);
  const GridPoint r = corner(-1, 1, -1);
  const GridPoint s = corner(-1, -1, 1);
  SceneData data;
  add_polygon(data, {p, q, r});
  add_polygon(data, {p, s, q});
  add_polygon(data, {p, r, s});
  add_polygon(data, {q, s, r});
  const Scene scene = made(std::move(data));
  const BspTree tree = build(scene, BuildOptions{});
  CameraData eye = camera_of(65536 * 256 / 100, 65536);
  eye.s0.x = eye.s0.y = -100 * eye.sx.x;
  eye.width_px = eye.height_px = kPixels;
  const Camera camera = *make_camera(eye, 26);
  ImageOptions image;
  image.clips = {{1, 0, 4, -4 * kDepth}};
  image.caps = CapStyle{{1, 2, 3}, Rgb{201, 202, 203}};
  const Rendering whole = render_samples(scene, tree, camera, image, 8, {});
  std::int32_t rows_of_cap = 0;
  for (std::int32_t top = 0; top < kPixels; top += kRows) {
    RenderOptions strip;
    const std::int32_t end = std::min(top + kRows, kPixels);
    strip.rectangle = Rectangle{0, top, kPixels, end};
    const Rendering one = render_samples(scene, tree, camera, image, 8, strip);
    bool shows_cap = false;
    for (std::int32_t j = top; j < end; ++j) {
      for (std::int32_t i = 0; i < kPixels; ++i) {
        const Rgb color = one.colors.at(i, j - top);
        ASSERT_TRUE(whole.colors.at(i, j) == color) << i << ' ' << j;
        shows_cap = shows_cap || color == image.caps->color;
      }
    }
    rows_of_cap += shows_cap ? 1 : 0;
  }
  EXPECT_GE(rows_of_cap, 4);
}

}  // namespace
}  // namespace halfspace::fast
