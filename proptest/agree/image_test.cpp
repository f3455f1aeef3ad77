#include <gtest/gtest.h>

#include <string>

#include "adapters/screen_line.hpp"
#include "generate/random_scenes.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/scan.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/fast/split.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/screen.hpp"
#include "halfspace/ref/split.hpp"
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
  for (const auto level : kSimdLevels) {
    how.simd = level;
    const fast::Rendering other =
        fast::render(scene, tree, camera, options, how);
    ASSERT_EQ(other.items, expected.items);
    ASSERT_EQ(other.colors, expected.colors);
  }

  how.simd =
      draws.one_in(2) ? fast::SimdLevel::kPortable : fast::SimdLevel::kBest;
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

  // Colours alone.
  how.colors = true;
  how.items = false;
  how.threads = 1;
  for (const auto level : kSimdLevels) {
    how.simd = level;
    fast::render(scene, tree, camera, options, how, part);
    ASSERT_EQ(part.colors, expected.colors);
    ASSERT_TRUE(part.items.pixels.empty());
  }
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
        // Leaves of many fragments go another way than those of few.
        display.leaf_size = draws.one_in(2)
                                ? 64
                                : static_cast<std::size_t>(draws.from_to(1, 8));
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

TEST(AgreeImage, LeavesOfManySmallPolygons) {
  fast::FilterStats stats;
  compare(40, 200, 60, 2, stats);
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

/// Whole polygons and what is left of them after cuts, one by one.
TEST(AgreeImage, FragmentsCoverTheSameSegments) {
  std::size_t segments = 0;
  fast::FilterStats stats;
  for (const Kind kind : kKinds) {
    for (const int bits : kGridBits) {
      for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(std::string(name_of(kind)) + ", " + std::to_string(bits) +
                     " bits, seed " + std::to_string(seed));
        Draws draws(seed * 77 + static_cast<std::uint64_t>(bits));
        const Scene scene = random_scene(kind, bits, 6, draws);
        const Camera camera = random_camera(kind, scene, 50, 20, draws);
        const ref::Projection projection = ref::projection_of(camera);
        const auto planes = ref::planes_of(scene);
        const auto count = static_cast<PolygonId>(scene.polygon_count());
        for (PolygonId p = 0; p < count; ++p) {
          ref::Fragment f = ref::whole(scene, p);
          fast::Fragment g = fast::whole(scene, p);
          for (PolygonId s = 0; s < count; ++s) {
            const auto expected = ref::scan_convert(f, projection);
            const auto found = fast::scan_convert(scene, g, camera, stats);
            ASSERT_EQ(found.size(), expected.size());
            segments += found.size();
            for (std::size_t k = 0; k < found.size(); ++k) {
              ASSERT_EQ(found[k].line, expected[k].line);
              ASSERT_EQ(found[k].span, expected[k].span);
            }
            const ref::Plane& plane = planes[static_cast<std::size_t>(s)];
            if (ref::relation(f, plane) != Relation::kSpanning) continue;
            const bool up = draws.one_in(2);
            const auto parts = ref::split(f, plane, s);
            const auto cut = fast::split(scene, g, s, stats);
            f = up ? parts.positive : parts.negative;
            g = up ? cut.positive : cut.negative;
          }
        }
      }
    }
  }
  EXPECT_GT(segments, 1000u);
}

/// All pairs of lines of 7 pixels, with every way to cut their runs up.
TEST(AgreeImage, MergesAreTheSameOnEveryShortLine) {
  constexpr std::int32_t kPixels = 7;
  std::vector<std::vector<Span>> lists;
  for (std::uint32_t lit = 0; lit < 1u << kPixels; ++lit) {
    // A bit of `joined` says that a pixel goes on its left neighbour's run.
    for (std::uint32_t joined = 0; joined < 1u << kPixels; ++joined) {
      if ((joined & ~(lit & (lit << 1))) != 0) continue;
      std::vector<Span> list;
      for (std::int32_t i = 0; i < kPixels; ++i) {
        if (((lit >> i) & 1u) == 0) continue;
        if (((joined >> i) & 1u) != 0) {
          list.back().last = i;
        } else {
          list.push_back({i, i});
        }
      }
      lists.push_back(list);
    }
  }
  for (const fast::SimdLevel level : kSimdLevels) {
    if (!fast::is_supported(level)) continue;
    ScreenLine line(kPixels, level);
    for (const auto& objects : lists) {
      for (const auto& unlit : lists) {
        const ref::Merged expected = ref::merge(objects, unlit);
        const ScreenLine::Merged& found = line.merge(objects, unlit);
        ASSERT_EQ(found.lit, expected.lit) << level_name(level);
        ASSERT_EQ(found.unlit, expected.unlit) << level_name(level);
      }
    }
  }
  for (const Span object : {Span{0, 2}, Span{1, 5}, Span{3, 3}, Span{4, 9}}) {
    for (std::int32_t first = 0; first < 8; ++first) {
      for (std::int32_t last = first; last < 8; ++last) {
        ASSERT_EQ(fast::merge_case(object, {first, last}),
                  ref::merge_case(object, {first, last}));
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::agree
