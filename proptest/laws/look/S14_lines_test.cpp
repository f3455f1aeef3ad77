#include <algorithm>
#include <cmath>
#include <vector>

#include "adapters/both.hpp"
#include "definition/definition.hpp"
#include "halfspace/fast/shade/lines.hpp"
#include "halfspace/ref/lines.hpp"
#include "laws/changed_views.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

using definition::Fraction;

/// The implementations, as these laws see them: lines of a view over white.
struct RefLines {
  static ColorImage lines(const SceneFile& view, const LineStyle& style,
                          std::int32_t samples) {
    ColorImage image((*view.camera)->width_px, (*view.camera)->height_px,
                     Rgb{255, 255, 255});
    ref::add_lines(ref::draw(view.scene, *view.camera), style, samples, image);
    return image;
  }
};
struct FastLines {
  static ColorImage lines(const SceneFile& view, const LineStyle& style,
                          std::int32_t samples) {
    ColorImage image((*view.camera)->width_px, (*view.camera)->height_px,
                     Rgb{255, 255, 255});
    fast::LineOptions how;
    how.samples = samples;
    fast::add_lines(*fast::draw(view.scene, *view.camera), style, how, image);
    return image;
  }
};

template <class Impl>
class S14Lines : public ::testing::Test {};
using LineImplementations = ::testing::Types<RefLines, FastLines>;
TYPED_TEST_SUITE(S14Lines, LineImplementations);

constexpr int kLineViews = 150;

Fraction fraction_of(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  const definition::Integer whole =
      static_cast<std::int64_t>(std::ldexp(mantissa, 53));
  const int shift = exponent - 53;
  const definition::Integer scale = definition::Integer(1) << std::abs(shift);
  return shift < 0 ? Fraction(whole, scale) : Fraction(whole * scale);
}

/// The square of the distance of a point from a segment: that of the segment's
/// point at the share of the way that is nearest, kept within it.
Fraction squared_distance(const Fraction& x, const Fraction& y,
                          const fast::Stroke& s) {
  const Fraction ax = fraction_of(s.from.x), ay = fraction_of(s.from.y);
  const Fraction dx = fraction_of(s.to.x) - ax, dy = fraction_of(s.to.y) - ay;
  const Fraction length = dx * dx + dy * dy;
  Fraction share = 0;
  if (length != 0) share = ((x - ax) * dx + (y - ay) * dy) / length;
  if (share < 0) share = 0;
  if (share > 1) share = 1;
  const Fraction px = x - ax - share * dx, py = y - ay - share * dy;
  return px * px + py * py;
}

/// Twice the style's width as small and large ones, whole pixels among them.
LineStyle style_of(std::size_t round) {
  LineStyle style;
  style.width = std::vector<std::int32_t>{16, 1, 32, 23, 48, 16, 7}[round % 7];
  style.color = {10, 20, 30};
  if (round % 3 == 2) style.classes = kAllClasses & ~set_of(EdgeClass::kBorder);
  return style;
}

TYPED_TEST(S14Lines, L1APixelIsOnALineWithinHalfItsWidth) {
  std::size_t round = 0;
  std::size_t on = 0;
  std::size_t ties = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const std::size_t salt = ++round;
        const LineStyle style = style_of(salt);
        const std::int32_t k = salt % 5 == 0 ? 2 : 1;
        const auto drawing = *fast::draw(view.scene, *view.camera);
        const Fraction reach = Fraction(style.width) / 32;
        const ColorImage image = TypeParam::lines(view, style, k);
        for (std::int32_t j = 0; j < image.height_px; ++j) {
          for (std::int32_t i = 0; i < image.width_px; ++i) {
            int count = 0;
            for (std::int32_t s = 0; s < k * k; ++s) {
              const Fraction x = i + Fraction(2 * (s % k) + 1) / (2 * k);
              const Fraction y = j + Fraction(2 * (s / k) + 1) / (2 * k);
              bool is_on = false;
              for (const fast::Stroke& stroke : drawing.strokes) {
                if (stroke.layers > 0 ||
                    (style.classes & set_of(stroke.edge_class)) == 0)
                  continue;
                const Fraction distance = squared_distance(x, y, stroke);
                is_on = is_on || distance <= reach * reach;
                ties += distance == reach * reach;
              }
              count += is_on;
            }
            on += static_cast<std::size_t>(count);
            const auto channel = [&](int line) {
              const int sum = count * line + (k * k - count) * 255;
              return static_cast<std::uint8_t>(
                  std::floor(sum / double{static_cast<double>(k * k)} + 0.5));
            };
            HALFSPACE_LAW(image.at(i, j) ==
                          (Rgb{channel(10), channel(20), channel(30)}));
          }
        }
      },
      kLineViews);
  EXPECT_GT(on, 1000u);
  EXPECT_GT(ties, 100u);
}

TYPED_TEST(S14Lines, L2WiderLinesAndMoreClassesCoverMore) {
  std::size_t round = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        LineStyle style = style_of(++round);
        const ColorImage narrow = TypeParam::lines(view, style, 1);
        style.width += static_cast<std::int32_t>(round % 20);
        style.classes = kAllClasses;
        const ColorImage wide = TypeParam::lines(view, style, 1);
        for (std::size_t p = 0; p < wide.pixels.size(); ++p) {
          HALFSPACE_LAW(narrow.pixels[p] != style.color ||
                        wide.pixels[p] == style.color);
        }
      },
      kLineViews);
}

}  // namespace
}  // namespace halfspace
