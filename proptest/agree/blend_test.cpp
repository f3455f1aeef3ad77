#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "generate/clip_planes.hpp"
#include "generate/random_scenes.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/ref/oracle/painter.hpp"

/// Back to front over every kind of tree: the painter's image, and the
/// transparent one.
namespace halfspace::agree {
namespace {

/// The painter's and the transparent image, by `threads` threads.
void expect_same(const Scene& scene, const fast::BspTree& tree,
                 const Camera& camera, const ImageOptions& options,
                 std::uint8_t alpha, const ref::Rendering& painted,
                 const ref::Rendering& blended) {
  fast::RenderOptions how;
  constexpr std::pair<int, fast::SimdLevel> kAll[] = {
      {1, fast::SimdLevel::kBest},
      {2, fast::SimdLevel::kPortable},
      {3, fast::SimdLevel::kAvx2}};
  for (const auto& [threads, level] : kAll) {
    how.threads = threads;
    how.simd = level;
    const auto paint = fast::paint(scene, tree, camera, options, how);
    ASSERT_EQ(paint.items, painted.items);
    ASSERT_EQ(paint.colors, painted.colors);
    const auto blend = fast::blend(scene, tree, camera, options, alpha, how);
    ASSERT_EQ(blend.items, blended.items);
    ASSERT_EQ(blend.colors, blended.colors);
    ASSERT_EQ(blend.pixels_painted, blended.pixels_painted);
  }
}

TEST(AgreeBlend, TransparentImagesOfScenesMadeToHurt) {
  std::size_t layers = 0;
  std::size_t pixels = 0;
  std::size_t divided = 0;
  for (const Kind kind : kKinds) {
    for (const int bits : kGridBits) {
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(std::string(name_of(kind)) + ", " + std::to_string(bits) +
                     " bits, seed " + std::to_string(seed));
        Draws draws(seed * 1000 + static_cast<std::uint64_t>(bits));
        const Scene scene = random_scene(kind, bits, 8, draws, true);
        const Camera camera = random_camera(
            kind, scene, static_cast<std::int32_t>(draws.from_to(1, 40)),
            static_cast<std::int32_t>(draws.from_to(1, 24)), draws);
        ImageOptions options;
        options.cull = draws.one_in(3);
        options.shading = draws.one_in(2) ? Shading::kGouraud : Shading::kFlat;
        options.background = {1, 2, 200};
        const auto alpha = static_cast<std::uint8_t>(draws.from_to(0, 255));
        const ref::BspTree ref_tree = ref::build(scene, {});
        const auto painted = ref::paint(scene, ref_tree, camera, options);
        const auto blended =
            ref::blend(scene, ref_tree, camera, options, alpha);
        layers += blended.pixels_painted;
        pixels += blended.items.pixels.size();
        expect_same(scene, fast::build(scene, {}), camera, options, alpha,
                    painted, blended);
        if (HasFatalFailure()) return;
        fast::DisplayTreeOptions display;
        display.leaf_size = static_cast<std::size_t>(draws.from_to(1, 8));
        display.own_planes = draws.one_in(2) ? 8 : 0;
        display.threads = 1;
        fast::BspTree tree = fast::build_display_tree(scene, display);
        if (fast::has_leaves(tree)) ++divided;
        expect_same(scene, tree, camera, options, alpha, painted, blended);
        if (HasFatalFailure()) return;
        fast::divide_leaves(tree, scene);
        ASSERT_FALSE(fast::has_leaves(tree));
        expect_same(scene, tree, camera, options, alpha, painted, blended);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(layers, pixels / 4);
  EXPECT_GT(divided, 20u);
}

/// Clip planes (S10.2), in every kind of tree.
TEST(AgreeBlend, WhatClipPlanesLeaveIsBlended) {
  std::size_t layers = 0;
  for (const Kind kind : kKinds) {
    for (const int bits : kGridBits) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(std::string(name_of(kind)) + ", " + std::to_string(bits) +
                     " bits, seed " + std::to_string(seed));
        Draws draws(seed * 1000 + static_cast<std::uint64_t>(bits));
        const Scene scene = random_scene(kind, bits, 8, draws, true);
        const Camera camera = random_camera(kind, scene, 33, 17, draws);
        ImageOptions options;
        options.shading = draws.one_in(2) ? Shading::kGouraud : Shading::kFlat;
        options.clips = generate::clip_planes(
            scene, draws.next(),
            static_cast<std::uint64_t>(draws.from_to(1, 3)));
        const auto alpha = static_cast<std::uint8_t>(draws.from_to(0, 255));
        const ref::BspTree ref_tree = ref::build(scene, {});
        const auto painted = ref::paint(scene, ref_tree, camera, options);
        const auto blended =
            ref::blend(scene, ref_tree, camera, options, alpha);
        layers += blended.pixels_painted;
        expect_same(scene, fast::build_display_tree(scene), camera, options,
                    alpha, painted, blended);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(layers, 1000u);
}

TEST(AgreeBlend, ATreeOfNothingHasNoLeavesToDivide) {
  fast::BspTree tree = fast::build_display_tree(Scene(), {});
  fast::divide_leaves(tree, Scene());
  EXPECT_TRUE(tree.nodes.empty());
}

}  // namespace
}  // namespace halfspace::agree
