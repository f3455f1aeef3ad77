#include <algorithm>
#include <optional>
#include <vector>

#include "adapters/both.hpp"
#include "generate/clip_planes.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/area_image.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/ref/area_image.hpp"
#include "halfspace/ref/visible_map.hpp"
#include "halfspace/splitmix.hpp"
#include "laws/frames/cap_looks.hpp"
#include "laws/frames/cut_scenes.hpp"
#include "laws/law.hpp"
#include "laws/map/map_arcs.hpp"

/// Laws of exact areas of sections, and of their maps (S10.5).
namespace halfspace {
namespace {

using namespace cut_scenes;

constexpr int kAreaViews = 160;

/// What the reference's map takes up to a second for.
constexpr std::size_t kMostPolygons = 18;

ColorImage fast_areas(const SceneFile& view) {
  return fast::render_area(view.scene, fast::build(view.scene, {}),
                           *view.camera, view.options,
                           1 + static_cast<int>(section_number_of(view) % 3))
      .colors;
}

struct RefSectionAreas {
  static ColorImage areas(const SceneFile& view) {
    return ref::render_area(view.scene, *view.camera, view.options);
  }
};
struct FastSectionAreas {
  static ColorImage areas(const SceneFile& view) { return fast_areas(view); }
};

template <class Impl>
class S10Areas : public ::testing::Test {};
using AreaImplementations = ::testing::Types<RefSectionAreas, FastSectionAreas>;
TYPED_TEST_SUITE(S10Areas, AreaImplementations);

generate::Views solid_views() {
  return rc::gen::oneOf(generate::nested_solids(), generate::touching_solids());
}

TYPED_TEST(S10Areas, L6AreasAreThoseOfTheSceneCutBeforehand) {
  std::size_t capped = 0;
  law::for_all(solid_views(), kAreaViews, [&](const SceneFile& whole) {
    if (!is_of_boxes(whole.scene)) return;
    SceneFile view = whole;
    view.options.shading = Shading::kFlat;
    const AxisCut cut = cut_of(view);
    const CapStyle style{{9, 208, 77}, std::nullopt};
    const auto beforehand = cut_beforehand_of(view, cut, style.color);
    if (!beforehand) return;  // a part is too thin for the grid
    const bool has_cap = beforehand->has_cap;
    view.options.clips = {clip_of(cut)};
    view.options.caps = style;
    HALFSPACE_LAW(TypeParam::areas(view) == fast_areas(beforehand->view));
    capped += has_cap ? 1u : 0u;
  });
  EXPECT_GT(capped, 15u);
}

/// The view with planes that cut it, and caps in three of four; nothing of
/// scenes that are open, empty or too large.
std::optional<SceneFile> section_of(const SceneFile& whole,
                                    std::size_t most_polygons) {
  if (whole.scene.polygon_count() == 0 ||
      whole.scene.polygon_count() > most_polygons ||
      !bad_edges(whole.scene).empty())
    return std::nullopt;
  SceneFile view = whole;
  const std::uint64_t number = section_number_of(view);
  view.options.clips =
      generate::clip_planes(view.scene, number, 1 + number % 3);
  if (view.options.clips.empty()) return std::nullopt;
  if (number % 4 != 0)
    view.options.caps = CapStyle{{9, 208, 77}, Rgb{200, 1, 100}};
  if (number % 4 == 2) tell_parts_apart(view);
  return view;
}

class S10AreasAgree : public ::testing::Test {};

TEST_F(S10AreasAgree, L6BothLibrariesGiveOneImage) {
  std::size_t changed = 0;
  law::for_all(solid_views(), 2 * kAreaViews, [&](const SceneFile& whole) {
    const std::optional<SceneFile> view = section_of(whole, kMostPolygons);
    if (!view) return;
    const ColorImage image = fast_areas(*view);
    HALFSPACE_LAW(image ==
                  ref::render_area(view->scene, *view->camera, view->options));
    SceneFile open = *view;
    open.options.caps = std::nullopt;
    changed += image != fast_areas(open) ? 1u : 0u;
  });
  EXPECT_GT(changed, 8u);
}

TEST_F(S10AreasAgree, L6BothLibrariesTellPartsApart) {
  std::size_t of_several = 0;
  for (std::uint64_t number = 0; number < 5; ++number) {
    SceneFile view = cut_boxes(number, 2, 6, 5);
    tell_parts_apart(view);
    const ColorImage image = fast_areas(view);
    ASSERT_EQ(image.pixels,
              ref::render_area(view.scene, *view.camera, view.options).pixels)
        << number;
    const ItemImage items =
        oracle::zbuffer(view.scene, *view.camera, view.options).items;
    const auto several =
        static_cast<PolygonId>(view.scene.polygon_count() + 32);
    of_several += static_cast<std::size_t>(
        std::count(items.pixels.begin(), items.pixels.end(), several));
  }
  EXPECT_GT(of_several, 2u);
}

struct RefSectionMap {
  static constexpr std::size_t kMost = kMostPolygons;
  static map_arcs::Arcs arcs_of(const SceneFile& view) {
    return map_arcs::exact_arcs(
        ref::section_map(view.scene, *view.camera, view.options));
  }
};
struct FastSectionMap {
  static constexpr std::size_t kMost = 1000;
  static map_arcs::Arcs arcs_of(const SceneFile& view) {
    const auto map =
        fast::section_map(view.scene, fast::build(view.scene, {}), *view.camera,
                          {view.options.cull, {}}, view.options);
    HALFSPACE_LAW(map.has_value());
    return map_arcs::exact_arcs(*map);
  }
};

template <class Impl>
class S10SectionMap : public ::testing::Test {};
using SectionMaps = ::testing::Types<RefSectionMap, FastSectionMap>;
TYPED_TEST_SUITE(S10SectionMap, SectionMaps);

TYPED_TEST(S10SectionMap, L7SamplesLieInTheRegionOfTheirItem) {
  std::size_t capped = 0;
  std::size_t hatched = 0;
  law::for_all(solid_views(), 2 * kAreaViews, [&](const SceneFile& whole) {
    const auto view = section_of(whole, TypeParam::kMost);
    if (!view) return;
    const auto arcs = TypeParam::arcs_of(*view);
    const Image image =
        oracle::zbuffer(view->scene, *view->camera, view->options);
    const auto count = static_cast<PolygonId>(view->scene.polygon_count());
    for (std::int32_t j = 0; j < image.items.height_px; ++j) {
      for (std::int32_t i = 0; i < image.items.width_px; ++i) {
        PolygonId key = image.items.at(i, j);
        if (key >= count) {
          ++capped;
          const auto beyond = static_cast<std::size_t>(key - count);
          const Rgb color = stripe_color(view->options, beyond, i, j, 1);
          const CapItem cap = cap_item(beyond);
          const auto& hatch = style_of(view->options, cap).hatch;
          if (color == hatch) {
            ++hatched;
            key += PolygonId{kMostClipPlanes};
          }
        }
        HALFSPACE_LAW(map_arcs::key_at(arcs, i, j) == key);
      }
    }
  });
  EXPECT_GT(hatched, 4u);
  EXPECT_GT(capped, 2 * hatched);
}

}  // namespace
}  // namespace halfspace
