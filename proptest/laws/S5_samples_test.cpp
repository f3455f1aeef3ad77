#include <algorithm>
#include <cstdlib>
#include <utility>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "laws/changed_views.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

using definition::Fraction;

template <class Impl>
class S5Samples : public ::testing::Test {};
TYPED_TEST_SUITE(S5Samples, Implementations);

constexpr int kFewViews = 140;

/// A channel of a polygon at the centre of pixel (i, j), not rounded.
Fraction value_at(const SceneFile& view, PolygonId id, std::int32_t i,
                  std::int32_t j, std::uint8_t Rgb::*channel) {
  if (id == kBackground) return view.options.background.*channel;
  const auto colors = view.scene.corner_colors(id);
  if (view.options.shading == Shading::kFlat || colors.empty())
    return view.scene.color(id).*channel;
  if (std::all_of(colors.begin(), colors.end(),
                  [&](const Rgb& c) { return c == colors.front(); }))
    return colors.front().*channel;
  const definition::Projection seen = definition::project(
      definition::facet_of(view.scene, definition::whole(view.scene, id)),
      *view.camera, false);
  definition::Integer weights = 0;
  definition::Integer sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const definition::Affine& f = seen.edges[k];
    const definition::Integer weight =
        2 * f.c + (2 * i + 1) * f.x + (2 * j + 1) * f.y;
    // The edge that leaves corner k is opposite corner k + 2.
    weights += weight;
    sum += weight * int{colors[(k + 2) % 3].*channel};
  }
  return Fraction(sum) / Fraction(weights);
}

std::uint8_t rounded(const Fraction& value) {
  const definition::Integer twice = 2 * numerator(value) + denominator(value);
  return static_cast<std::uint8_t>(twice / (2 * denominator(value)));
}

TYPED_TEST(S5Samples, L20APixelIsTheMeanOfItsSamples) {
  std::size_t compared = 0;
  std::size_t mixed = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const auto tree = TypeParam::build(view.scene, {});
        for (const std::int32_t k : {2, 4, 8}) {
          const auto large = magnified(view, k);
          if (!large) continue;
          ++compared;
          const Image image = TypeParam::render_samples(
              view.scene, tree, *view.camera, view.options, k);
          HALFSPACE_LAW(image.items == definition::item_image(large->scene,
                                                              *large->camera,
                                                              large->options));
          HALFSPACE_LAW(image.colors.width_px == (*view.camera)->width_px);
          HALFSPACE_LAW(image.colors.height_px == (*view.camera)->height_px);
          for (std::int32_t j = 0; j < image.colors.height_px; ++j) {
            for (std::int32_t i = 0; i < image.colors.width_px; ++i) {
              for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
                Fraction sum = 0;
                for (std::int32_t s = 0; s < k * k; ++s) {
                  const std::int32_t column = i * k + s % k;
                  const std::int32_t row = j * k + s / k;
                  const PolygonId id = image.items.at(column, row);
                  if (id != image.items.at(i * k, j * k)) ++mixed;
                  sum += value_at(*large, id, column, row, channel);
                }
                HALFSPACE_LAW(image.colors.at(i, j).*channel ==
                              rounded(sum / (k * k)));
              }
            }
          }
        }
      },
      kFewViews);
  EXPECT_GT(compared, 100u);
  EXPECT_GT(mixed, 1000u);
}

TYPED_TEST(S5Samples, L20OneSampleIsTheImage) {
  law::for_all_views(
      [&](const SceneFile& view) {
        const auto tree = TypeParam::build(view.scene, {});
        const Image one = TypeParam::render_samples(
            view.scene, tree, *view.camera, view.options, 1);
        const Image image =
            TypeParam::render(view.scene, tree, *view.camera, view.options);
        HALFSPACE_LAW(one.items == image.items);
        HALFSPACE_LAW(one.colors == image.colors);
      },
      kFewViews);
}

}  // namespace
}  // namespace halfspace
