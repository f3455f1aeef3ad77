#include "halfspace/fast/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "halfspace/fast/build.hpp"
#include "halfspace/fast/painter.hpp"
#include "scenes.hpp"
#include "tree/leaf_packets.hpp"

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
