#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/looks.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "laws/changed_views.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

using definition::Fraction;

template <class Impl>
class S5Samples : public ::testing::Test {};
TYPED_TEST_SUITE(S5Samples, Implementations);

constexpr int kFewViews = 150;
constexpr int kSampledViews = 390;

constexpr std::uint8_t Rgb::*kChannels[] = {&Rgb::r, &Rgb::g, &Rgb::b};

/// A colour at a sample, not rounded: each channel is `channel` / `weight`.
struct SampleColor {
  definition::Integer channel[3];
  definition::Integer weight = 1;
};

SampleColor exactly(const Rgb& color) {
  return {{color.r, color.g, color.b}, 1};
}

/// Colours of the view's polygons at pixels (S5.4).
class ColorsOfPixels {
 public:
  explicit ColorsOfPixels(const SceneFile& view)
      : view_(view), seen_(view.scene.polygon_count()) {}

  /// Of the polygon at the centre of pixel (i, j).
  SampleColor at(PolygonId id, std::int32_t i, std::int32_t j) {
    if (id == kBackground) return exactly(view_.options.background);
    const auto colors = view_.scene.corner_colors(id);
    if (view_.options.shading == Shading::kFlat || colors.empty())
      return exactly(view_.scene.color(id));
    if (std::all_of(colors.begin(), colors.end(),
                    [&](const Rgb& c) { return c == colors.front(); }))
      return exactly(colors.front());
    auto& seen = seen_[static_cast<std::size_t>(id)];
    if (!seen)
      seen = definition::project(
          definition::facet_of(view_.scene, definition::whole(view_.scene, id)),
          *view_.camera, false);
    SampleColor color{{0, 0, 0}, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const definition::Affine& f = seen->edges[k];
      const definition::Integer weight =
          2 * f.c + (2 * i + 1) * f.x + (2 * j + 1) * f.y;
      // The edge that leaves corner k is opposite corner k + 2.
      color.weight += weight;
      for (std::size_t c = 0; c < 3; ++c)
        color.channel[c] += weight * int{colors[(k + 2) % 3].*kChannels[c]};
    }
    return color;
  }

 private:
  const SceneFile& view_;
  std::vector<std::optional<definition::Projection>> seen_;
};

/// The mean of the samples, rounded half up.
std::uint8_t mean_of(const std::vector<SampleColor>& samples, std::size_t c) {
  // Sums of quotients rounded down are short by less than one a sample.
  constexpr int kBits = 64;
  const definition::Integer count = samples.size();
  definition::Integer sum = 0;
  for (const SampleColor& s : samples)
    sum += (s.channel[c] << kBits) / s.weight;
  const auto rounded = [&](const definition::Integer& total) {
    const definition::Integer whole = count << kBits;
    return static_cast<std::uint8_t>((2 * total + whole) / (2 * whole));
  };
  if (rounded(sum) == rounded(sum + count)) return rounded(sum);
  Fraction total = 0;
  for (const SampleColor& s : samples)
    total += Fraction(s.channel[c]) / Fraction(s.weight);
  total /= Fraction(count);
  const definition::Integer twice = 2 * numerator(total) + denominator(total);
  return static_cast<std::uint8_t>(twice / (2 * denominator(total)));
}

TYPED_TEST(S5Samples, L20APixelIsTheMeanOfItsSamples) {
  constexpr std::int32_t kCounts[] = {2, 4, 2, 8, 2, 4};
  std::size_t compared = 0;
  std::size_t mixed = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const std::int32_t k = kCounts[seed_of(view) % std::size(kCounts)];
        const auto large = magnified(view, k);
        if (!large) return;
        ++compared;
        const auto tree = TypeParam::build(view.scene, {});
        const Image image = TypeParam::render_samples(
            view.scene, tree, *view.camera, view.options, k);
        HALFSPACE_LAW(image.items == definition::item_image(large->scene,
                                                            *large->camera,
                                                            large->options));
        HALFSPACE_LAW(image.colors.width_px == (*view.camera)->width_px);
        HALFSPACE_LAW(image.colors.height_px == (*view.camera)->height_px);
        ColorsOfPixels colors(*large);
        std::vector<SampleColor> samples;
        for (std::int32_t j = 0; j < image.colors.height_px; ++j) {
          for (std::int32_t i = 0; i < image.colors.width_px; ++i) {
            samples.clear();
            for (std::int32_t s = 0; s < k * k; ++s) {
              const std::int32_t column = i * k + s % k;
              const std::int32_t row = j * k + s / k;
              const PolygonId id = image.items.at(column, row);
              if (id != image.items.at(i * k, j * k)) ++mixed;
              samples.push_back(colors.at(id, column, row));
            }
            for (std::size_t c = 0; c < 3; ++c) {
              HALFSPACE_LAW(image.colors.at(i, j).*kChannels[c] ==
                            mean_of(samples, c));
            }
          }
        }
      },
      kSampledViews);
  EXPECT_GT(compared, 300u);
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

/// A view with corner colours, smooth in two of three.
SceneFile in_colors(const SceneFile& view, std::uint64_t seed) {
  SceneFile changed = with_corner_colors(view);
  changed.options.shading = seed % 3 == 0 ? Shading::kFlat : Shading::kGouraud;
  changed.options.background = {1, 2, 200};
  return changed;
}

TYPED_TEST(S5Samples, L22SamplesOfLooksAreAnImageSoManyTimesAsLarge) {
  std::size_t compared = 0, marked = 0;
  law::for_all_views(
      [&](const SceneFile& original) {
        const std::uint64_t seed = seed_of(original);
        const SceneFile view = in_colors(original, seed);
        const std::int32_t k = seed % 8 == 0 ? 8 : seed % 4 == 1 ? 4 : 2;
        const auto large = magnified(view, k);
        if (!large) return;
        Look look;
        look.alpha = seed % 3 == 1   ? kOpaque
                     : seed % 5 == 0 ? 0
                                     : static_cast<std::uint8_t>(seed >> 9);
        if (look.alpha == kOpaque || seed % 2 == 0) look.mark = {255, 130, 7};
        ++compared;
        const Image fine = looks_of<Ref>(*large, look)[0];
        const ColorImage expected = smaller(fine.colors, k);
        Look plain = look;
        plain.mark.reset();
        plain.samples = look.samples = k;
        if (look.mark)
          marked += looks_of<Ref>(view, plain)[0].colors != expected;
        for (const Image& image : looks_of<TypeParam>(view, look)) {
          HALFSPACE_LAW(image.items == fine.items);
          HALFSPACE_LAW(image.colors == expected);
        }
      },
      kFewViews);
  EXPECT_GT(compared, 100u);
  EXPECT_GT(marked, 20u);
}

}  // namespace
}  // namespace halfspace
