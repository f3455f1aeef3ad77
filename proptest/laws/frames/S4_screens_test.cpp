#include <cstddef>
#include <utility>

#include "adapters/both.hpp"
#include "halfspace/fast/image/screens.hpp"
#include "halfspace/ref/screens.hpp"
#include "laws/law.hpp"

/// The law of screens of four kinds (S4.9).
namespace halfspace {
namespace {

constexpr ScreenKind kAllScreens[] = {ScreenKind::kList, ScreenKind::kBsp1,
                                      ScreenKind::kQuad, ScreenKind::kBsp2};

struct RefScreens {
  static Image image(const SceneFile& view, const ImageOptions& options,
                     ScreenKind kind) {
    auto image = ref::render_on(view.scene, ref::build(view.scene, {}),
                                *view.camera, options, kind);
    return {std::move(image.items), std::move(image.colors),
            image.pixels_painted};
  }
};

struct FastScreens {
  static Image image(const SceneFile& view, const ImageOptions& options,
                     ScreenKind kind) {
    auto image = fast::render_on(view.scene, fast::build(view.scene, {}),
                                 *view.camera, options, kind);
    return {std::move(image.items), std::move(image.colors),
            image.pixels_painted};
  }
};

template <class Impl>
class S4Screens : public ::testing::Test {};
using ScreenKindImplementations = ::testing::Types<RefScreens, FastScreens>;
TYPED_TEST_SUITE(S4Screens, ScreenKindImplementations);

TYPED_TEST(S4Screens, L12ScreensOfAllKindsGiveOneImage) {
  std::size_t lit = 0;
  law::for_all_views([&](const SceneFile& view) {
    ImageOptions options = view.options;
    options.clips.clear();
    options.caps = std::nullopt;
    const Image expected = oracle::zbuffer(view.scene, *view.camera, options);
    for (const ScreenKind kind : kAllScreens) {
      const Image image = TypeParam::image(view, options, kind);
      HALFSPACE_LAW(image.items == expected.items);
      HALFSPACE_LAW(image.colors == expected.colors);
      lit += image.pixels_painted;
    }
  });
  EXPECT_GT(lit, 1000u);
}

}  // namespace
}  // namespace halfspace
