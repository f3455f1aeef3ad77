#include "raster/layers/leaf_layers.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "halfspace/fast/build.hpp"
#include "halfspace/fast/painter.hpp"
#include "scenes.hpp"
#include "tree/leaf_packets.hpp"
#include "tree/node_boxes.hpp"

/// Leaves back to front: against trees that divide them, and against colours
/// that are known.
namespace halfspace::fast {
namespace {

constexpr std::int64_t kWide = 1 << 24;

/// All polygons of a scene of triangles in one leaf.
BspTree one_leaf(const Scene& scene) {
  BspTree tree;
  Node leaf;
  leaf.first_fragment = 0;
  tree.nodes.push_back(leaf);
  const auto count = static_cast<std::int32_t>(scene.polygon_count());
  for (std::int32_t k = 0; k < count; ++k) {
    tree.fragments.push_back({k, static_cast<std::uint32_t>(3 * k), 3, 0,
                              k + 1 < count ? k + 1 : kNoFragment});
    for (std::int32_t c = 0; c < 3; ++c) {
      tree.corners.push_back(
          {c, scene.data().corners[static_cast<std::size_t>(3 * k + c)]});
    }
  }
  return tree;
}

Camera camera_of(std::int32_t width, std::int32_t height) {
  CameraData seen;
  seen.perspective = false;
  seen.eye = {0, 0, -256};
  seen.s0 = {-std::int64_t{width} * 512, -std::int64_t{height} * 512, 0};
  seen.sx = {1024, 0, 0};
  seen.sy = {0, 1024, 0};
  seen.width_px = width;
  seen.height_px = height;
  const Result<Camera> camera = make_camera(seen, 26);
  EXPECT_TRUE(camera) << camera.error().message;
  return *camera;
}

std::uint8_t channel(std::mt19937_64& engine) {
  return static_cast<std::uint8_t>(engine() % 256);
}

/// Triangles that cross each other, steeply for floats, and some that lie on
/// one of them or cross it by a step.
Scene crossing(int count) {
  std::mt19937_64 engine(3);
  const auto number = [&engine](std::int64_t size) {
    return std::uniform_int_distribution<std::int64_t>(-size, size)(engine);
  };
  SceneData data;
  for (int k = 0; k < count; ++k) {
    const auto corner = [&] {
      return GridPoint{number(600), number(400), number(kWide)};
    };
    GridPoint a = corner(), b = corner();
    const GridPoint c = corner();
    for (int times = k % 5 < 2 ? 2 : 1; times > 0; --times) {
      add_polygon(data, {a, b, c});
      if (k % 5 == 1) {
        a.z += 1;
        b.z -= 1;
      }
      data.colors.back() = {channel(engine), channel(engine), channel(engine)};
      for (int v = 0; v < 3; ++v) {
        data.corner_colors.push_back(
            {channel(engine), channel(engine), channel(engine)});
      }
    }
  }
  return made(std::move(data));
}

void expect_equal(const Rendering& a, const Rendering& b) {
  EXPECT_TRUE(a.items == b.items);
  EXPECT_TRUE(a.colors == b.colors);
  EXPECT_EQ(a.pixels_painted, b.pixels_painted);
}

TEST(LeafLayers, CrossingLayersAreBlendedAsTheirParts) {
  const Scene scene = crossing(70);
  BspTree leaf = one_leaf(scene);
  BspTree divided = leaf;
  divide_leaves(divided, scene);
  EXPECT_GT(divided.fragments.size(), 10 * leaf.fragments.size());
  BspTree blocks = leaf;
  add_boxes(blocks, scene);
  add_blocks(blocks, scene);
  const Camera camera = camera_of(160, 100);
  for (const Shading shading : {Shading::kFlat, Shading::kGouraud}) {
    ImageOptions look;
    look.shading = shading;
    for (const std::uint8_t alpha : {std::uint8_t{77}, kOpaque}) {
      const Rendering parts = blend(scene, divided, camera, look, alpha);
      EXPECT_GT(parts.pixels_painted, 100'000u);
      for (const SimdLevel simd :
           {SimdLevel::kPortable, SimdLevel::kAvx2, SimdLevel::kBest}) {
        RenderOptions how;
        how.simd = simd;
        how.threads = simd == SimdLevel::kAvx2 ? 3 : 1;
        expect_equal(blend(scene, leaf, camera, look, alpha, how), parts);
        expect_equal(blend(scene, blocks, camera, look, alpha, how), parts);
      }
    }
    expect_equal(paint(scene, blocks, camera, look),
                 paint(scene, divided, camera, look));
  }
}

TEST(LeafLayers, ImagesThatAreNotWantedAreLeftOut) {
  const Scene scene = crossing(40);
  const BspTree leaf = one_leaf(scene);
  const Camera camera = camera_of(320, 200);
  ImageOptions look;
  look.shading = Shading::kGouraud;
  const Rendering both = blend(scene, leaf, camera, look, 100);
  for (const bool items : {false, true}) {
    RenderOptions one;
    one.items = items;
    one.colors = !items;
    const Rendering image = blend(scene, leaf, camera, look, 100, one);
    EXPECT_EQ(image.pixels_painted, both.pixels_painted);
    EXPECT_TRUE(items ? image.items == both.items
                      : image.colors == both.colors);
  }
}

/// More masks than are kept, in one row of tiles: it is shown by rows, and then
/// by tiles. All pixels have all layers, so the colour is known.
TEST(LeafLayers, ManyMasksAreShownInParts) {
  constexpr std::int32_t kCount = 1100, kWidth = 2040, kHeight = 21;
  static_assert(std::size_t{kCount} * ((kWidth + 31) / 32) >
                LeafLayers::kMostMasks);
  std::mt19937_64 engine(4);
  SceneData data;
  // The nearest, which has the least z, is in the middle of the list.
  const auto depth = [](std::int64_t k) { return (k * 7 + 500) % kCount; };
  for (std::int64_t k = 0; k < kCount; ++k) {
    add_polygon(data, {{-kWide, -kWide, depth(k)},
                       {kWide, -kWide, depth(k)},
                       {0, kWide, depth(k)}});
    data.colors.back() = {channel(engine), channel(engine), channel(engine)};
  }
  const Scene scene = made(std::move(data));
  std::vector<PolygonId> farthest_first(kCount);
  for (std::int64_t k = 0; k < kCount; ++k) {
    farthest_first[static_cast<std::size_t>(kCount - 1 - depth(k))] =
        static_cast<PolygonId>(k);
  }
  constexpr std::uint8_t kAlpha = 3;
  Rgb expected = {255, 255, 255};
  for (const PolygonId k : farthest_first) {
    for (const auto c : {&Rgb::r, &Rgb::g, &Rgb::b}) {
      const int parts =
          kAlpha * (scene.color(k).*c) + (255 - kAlpha) * (expected.*c);
      expected.*c = static_cast<std::uint8_t>((2 * parts + 255) / 510);
    }
  }
  const BspTree leaf = one_leaf(scene);
  const Camera camera = camera_of(kWidth, kHeight);
  for (const int threads : {1, 2}) {
    ImageOptions look;
    look.background = {255, 255, 255};
    RenderOptions how;
    how.threads = threads;
    const Rendering image = blend(scene, leaf, camera, look, kAlpha, how);
    EXPECT_EQ(image.pixels_painted, std::size_t{kCount} * kWidth * kHeight);
    // Three rows of tiles, each in two parts.
    EXPECT_EQ(image.fragments_displayed, std::size_t{6} * kCount);
    for (const Rgb& color : image.colors.pixels) ASSERT_EQ(color, expected);
    for (const PolygonId id : image.items.pixels) {
      ASSERT_EQ(id, farthest_first.back());
    }
  }
}

}  // namespace
}  // namespace halfspace::fast
