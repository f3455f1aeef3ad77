#include <gtest/gtest.h>

#include <string>

#include "agree_scenes.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/ref/traverse.hpp"

namespace halfspace::agree {
namespace {

ImageOptions random_options(Draws& draws) {
  ImageOptions options;
  options.cull = draws.one_in(3);
  options.shading = draws.one_in(2) ? Shading::kGouraud : Shading::kFlat;
  options.background = {1, 2, 3};
  return options;
}

/// The part of `image` in the rectangle.
template <class T>
Grid2<T> part_of(const Grid2<T>& image, const fast::Rectangle& r) {
  Grid2<T> part(r.right - r.left, r.bottom - r.top, T{});
  for (std::int32_t j = r.top; j < r.bottom; ++j) {
    for (std::int32_t i = r.left; i < r.right; ++i) {
      part.at(i - r.left, j - r.top) = image.at(i, j);
    }
  }
  return part;
}

fast::Rectangle random_rectangle(const CameraData& camera, Draws& draws) {
  fast::Rectangle r;
  r.left = static_cast<std::int32_t>(draws.from_to(0, camera.width_px - 1));
  r.right =
      static_cast<std::int32_t>(draws.from_to(r.left + 1, camera.width_px));
  r.top = static_cast<std::int32_t>(draws.from_to(0, camera.height_px - 1));
  r.bottom =
      static_cast<std::int32_t>(draws.from_to(r.top + 1, camera.height_px));
  return r;
}

/// Everything that may not change a pixel, changed.
void expect_same(const Scene& scene, const Camera& camera,
                 const ImageOptions& options, const ref::Rendering& expected,
                 const fast::BspTree& tree, Draws& draws,
                 fast::FilterStats& stats) {
  const fast::Rendering whole = fast::render(scene, tree, camera, options);
  stats.add(whole.decisions);
  ASSERT_EQ(whole.items, expected.items);
  ASSERT_EQ(whole.colors, expected.colors);
  ASSERT_EQ(whole.pixels_painted, expected.pixels_painted);

  fast::RenderOptions how;
  how.portable = true;
  const fast::Rendering portable =
      fast::render(scene, tree, camera, options, how);
  ASSERT_EQ(portable.items, expected.items);
  ASSERT_EQ(portable.colors, expected.colors);

  how.portable = draws.one_in(2);
  how.threads = 3;
  how.rectangle = random_rectangle(camera.data(), draws);
  fast::Rendering part = fast::render(scene, tree, camera, options, how);
  ASSERT_EQ(part.items, part_of(expected.items, *how.rectangle));
  ASSERT_EQ(part.colors, part_of(expected.colors, *how.rectangle));

  // Into a rendering that held another picture, without colours.
  how.rectangle = std::nullopt;
  how.colors = false;
  fast::render(scene, tree, camera, options, how, part);
  ASSERT_EQ(part.items, expected.items);
  ASSERT_TRUE(part.colors.pixels.empty());
}

/// Runs the comparison on scenes of every kind and grid.
void compare(int polygons, std::int64_t width, std::int64_t height,
             std::uint64_t seeds, fast::FilterStats& stats) {
  std::size_t seen = 0;
  std::size_t pixels = 0;
  for (const Kind kind : kKinds) {
    for (const int bits : kGridBits) {
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE(std::string(name_of(kind)) + ", " + std::to_string(bits) +
                     " bits, seed " + std::to_string(seed));
        Draws draws(seed * 1000 + static_cast<std::uint64_t>(bits));
        const Scene scene = random_scene(kind, bits, polygons, draws, true);
        const Camera camera = random_camera(
            kind, scene, static_cast<std::int32_t>(draws.from_to(1, width)),
            static_cast<std::int32_t>(draws.from_to(1, height)), draws);
        const ImageOptions options = random_options(draws);
        BuildOptions build;
        build.seed = seed;
        const ref::Rendering expected =
            ref::render(scene, ref::build(scene, build), camera, options);
        const fast::BspTree tree = fast::build(scene, build);
        expect_same(scene, camera, options, expected, tree, draws, stats);
        if (::testing::Test::HasFatalFailure()) return;
        fast::DisplayTreeOptions display;
        display.leaf_size = static_cast<std::size_t>(draws.from_to(1, 8));
        display.own_planes = draws.one_in(2) ? 8 : 0;
        display.threads = 1;
        expect_same(scene, camera, options, expected,
                    fast::build_display_tree(scene, display), draws, stats);
        if (::testing::Test::HasFatalFailure()) return;
        const fast::Rendering painted =
            fast::paint(scene, tree, camera, options);
        ASSERT_EQ(painted.items, expected.items);
        ASSERT_EQ(painted.colors, expected.colors);
        seen += expected.pixels_painted;
        pixels += expected.items.pixels.size();
      }
    }
  }
  // Empty images would agree, too.
  EXPECT_GT(seen, pixels / 10);
}

TEST(AgreeImage, SmallImagesOfScenesMadeToHurt) {
  fast::FilterStats stats;
  compare(8, 40, 24, 50, stats);
  EXPECT_GT(stats.filtered, 1000u);
  EXPECT_GT(stats.exact, 1000u);
  EXPECT_GT(stats.zero, 100u);
}

TEST(AgreeImage, ImagesOfManyTiles) {
  fast::FilterStats stats;
  compare(6, 150, 70, 6, stats);
}

TEST(AgreeImage, WideImagesCrossWordsOfTiles) {
  fast::FilterStats stats;
  Draws draws(11);
  for (const std::int32_t width : {2047, 2048, 2049, 4200}) {
    const Scene scene = random_scene(Kind::kWide, 26, 5, draws, true);
    const Camera camera = random_camera(Kind::kWide, scene, width, 9, draws);
    const ref::Rendering expected =
        ref::render(scene, ref::build(scene, {}), camera, {});
    expect_same(scene, camera, {}, expected, fast::build(scene, {}), draws,
                stats);
  }
}

TEST(AgreeImage, TraversalsDisplayTheSameFragmentsInTheSameOrder) {
  for (const Kind kind : kKinds) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(std::string(name_of(kind)) + ", seed " +
                   std::to_string(seed));
      Draws draws(seed);
      const Scene scene = random_scene(kind, 40, 12, draws);
      const Camera camera = random_camera(kind, scene, 10, 10, draws);
      const ref::BspTree expected_tree = ref::build(scene, {});
      const fast::BspTree tree = fast::build(scene, {});
      std::vector<std::pair<PolygonId, PolygonId>> expected;
      std::vector<std::pair<PolygonId, PolygonId>> shown;
      const auto expect = [&](const ref::Node& n, const ref::Fragment& f) {
        expected.emplace_back(n.splitter, f.source);
        return true;
      };
      const auto show = [&](const fast::Node& n, const fast::TreeFragment& f) {
        shown.emplace_back(n.splitter, f.source);
        return true;
      };
      ref::back_to_front(expected_tree, camera, expect);
      ref::front_to_back(expected_tree, camera, expect);
      fast::back_to_front(tree, scene, camera, show);
      fast::front_to_back(tree, scene, camera, show);
      ASSERT_EQ(shown, expected);
    }
  }
}

}  // namespace
}  // namespace halfspace::agree
