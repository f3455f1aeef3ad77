#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "adapters/both.hpp"
#include "definition/definition.hpp"
#include "generate/cut_boxes.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/fast/shade/lines.hpp"
#include "halfspace/ref/lines.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "laws/changed_views.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

using definition::Integer;

/// The implementations, as these laws see them: lines of a view over white.
struct RefLines {
  static ColorImage lines(const SceneFile& view, const LineStyle& style,
                          std::int32_t samples) {
    ColorImage image((*view.camera)->width_px, (*view.camera)->height_px,
                     Rgb{255, 255, 255});
    const auto drawing =
        ref::draw(view.scene, *view.camera, drawing_over(view.options));
    ref::add_lines(drawing, style, samples, image);
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
    const auto drawing =
        fast::draw(view.scene, *view.camera, drawing_over(view.options));
    fast::add_lines(*drawing, style, how, image);
    return image;
  }
};

template <class Impl>
class S14Lines : public ::testing::Test {};
using LineImplementations = ::testing::Types<RefLines, FastLines>;
TYPED_TEST_SUITE(S14Lines, LineImplementations);

constexpr int kLineViews = 150;

/// -1: nearer than the reach; 0: just as far; 1: farther.
using Sign = int;

/// A segment of the image in steps of 2^-bits pixels, which its ends are on.
class Segment {
 public:
  explicit Segment(const fast::Stroke& stroke) {
    for (const double v :
         {stroke.from.x, stroke.from.y, stroke.to.x, stroke.to.y}) {
      int exponent = 0;
      if (v != 0) std::frexp(v, &exponent);
      bits_ = std::max(bits_, 53 - exponent);
    }
    ax_ = steps_of(stroke.from.x), ay_ = steps_of(stroke.from.y);
    dx_ = steps_of(stroke.to.x) - ax_, dy_ = steps_of(stroke.to.y) - ay_;
  }

  /// Compares the distance of the point (x / 4, y / 4) with width / 32: that
  /// from the segment's nearest point, by squares.
  Sign compare(std::int32_t x, std::int32_t y, std::int32_t width) const {
    const Integer px = (Integer(x) << (bits_ - 2)) - ax_;
    const Integer py = (Integer(y) << (bits_ - 2)) - ay_;
    const Integer reach = Integer(width) << (bits_ - 5);
    const Integer length = dx_ * dx_ + dy_ * dy_;
    const Integer along = px * dx_ + py * dy_;
    if (along <= 0) return sign_of(px * px + py * py - reach * reach);
    if (along >= length) {
      const Integer qx = px - dx_, qy = py - dy_;
      return sign_of(qx * qx + qy * qy - reach * reach);
    }
    const Integer across = px * dy_ - py * dx_;
    return sign_of(across * across - reach * reach * length);
  }

 private:
  static Sign sign_of(const Integer& value) { return value.sign(); }

  Integer steps_of(double value) const {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    const Integer whole = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
    return value == 0 ? Integer(0) : whole << (bits_ + exponent - 53);
  }

  int bits_ = 5;  // as a reach needs
  Integer ax_, ay_, dx_, dy_;
};

/// Twice the style's width as small and large ones, whole pixels among them.
LineStyle style_of(std::uint64_t salt) {
  LineStyle style;
  style.width = std::vector<std::int32_t>{16, 1, 32, 23, 48, 16, 7}[salt % 7];
  style.color = {10, 20, 30};
  if (salt % 3 == 2) style.classes = kAllClasses & ~set_of(EdgeClass::kBorder);
  return style;
}

TYPED_TEST(S14Lines, L1APixelIsOnALineWithinHalfItsWidth) {
  std::size_t on = 0;
  std::size_t ties = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const std::uint64_t salt = seed_of(view);
        const LineStyle style = style_of(salt);
        const std::int32_t k = salt % 5 == 0 ? 2 : 1;
        const auto drawing =
            *fast::draw(view.scene, *view.camera, drawing_over(view.options));
        std::vector<Segment> segments;
        for (const fast::Stroke& stroke : drawing.strokes) {
          if (stroke.layers == 0 &&
              (style.classes & set_of(stroke.edge_class)) != 0)
            segments.emplace_back(stroke);
        }
        const ColorImage image = TypeParam::lines(view, style, k);
        for (std::int32_t j = 0; j < image.height_px; ++j) {
          for (std::int32_t i = 0; i < image.width_px; ++i) {
            int count = 0;
            for (std::int32_t s = 0; s < k * k; ++s) {
              const std::int32_t x = (2 * (i * k + s % k) + 1) * (2 / k);
              const std::int32_t y = (2 * (j * k + s / k) + 1) * (2 / k);
              bool is_on = false;
              for (const Segment& segment : segments) {
                const Sign sign = segment.compare(x, y, style.width);
                is_on = is_on || sign <= 0;
                ties += sign == 0;
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
  law::for_all_views(
      [&](const SceneFile& view) {
        const std::uint64_t salt = seed_of(view);
        LineStyle style = style_of(salt);
        const ColorImage narrow = TypeParam::lines(view, style, 1);
        style.width += static_cast<std::int32_t>(salt % 20);
        style.classes = kAllClasses;
        const ColorImage wide = TypeParam::lines(view, style, 1);
        for (std::size_t p = 0; p < wide.pixels.size(); ++p) {
          HALFSPACE_LAW(narrow.pixels[p] != style.color ||
                        wide.pixels[p] == style.color);
        }
      },
      kLineViews);
}

/// A number for what is seen at a pixel that differs where planes do.
class SeenPlanes {
 public:
  explicit SeenPlanes(const Scene& scene)
      : plane_of_(fast::intern_planes(scene).plane_of) {}
  std::int32_t of(PolygonId item) const {
    const bool is_polygon =
        item >= 0 && static_cast<std::size_t>(item) < plane_of_.size();
    return is_polygon ? plane_of_[static_cast<std::size_t>(item)] : -2 - item;
  }

 private:
  std::vector<std::int32_t> plane_of_;
};

/// What the reference's drawing takes up to a second for.
constexpr std::size_t kMostCut = 18;
constexpr int kCutViews = 75;

/// Calls the property for views that are cut, with caps where they can be: of
/// any scenes, of closed ones, and of boxes.
void for_all_sections(const std::function<void(const SceneFile&)>& property) {
  const auto cut = [&](SceneFile view) {
    if (view.scene.polygon_count() > kMostCut || view.camera->data().near)
      return;
    view.options.caps.reset();
    if (bad_edges(view.scene).empty()) view.options.caps = CapStyle{};
    if (!view.options.clips.empty()) property(view);
  };
  const auto views = rc::gen::oneOf(generate::views(), closed_views());
  law::for_all(views, kCutViews,
               [&](const SceneFile& whole) { cut(clipped(whole)); });
  law::check(kCutViews, [&] {
    const auto number = *rc::gen::arbitrary<std::uint64_t>();
    SceneFile view = cut_boxes(number, 2, 24, 18);
    view.options.cull = number % 5 == 0;
    cut(view);
  });
}

TYPED_TEST(S14Lines, L3PlanesSeenSideBySideHaveALineBetween) {
  std::size_t capped = 0;
  std::size_t clipped_off = 0;
  for_all_sections([&](const SceneFile& view) {
    LineStyle style;
    style.width = 17;
    const ColorImage lines = TypeParam::lines(view, style, 1);
    const ItemImage seen =
        ref::raycast(view.scene, *view.camera, view.options).items;
    const ItemImage of_all =
        ref::raycast(view.scene, *view.camera, {view.options.cull}).items;
    const SeenPlanes planes(view.scene);
    const auto count = static_cast<PolygonId>(view.scene.polygon_count());
    const auto check = [&](std::int32_t i, std::int32_t j, std::int32_t x,
                           std::int32_t y) {
      if (planes.of(seen.at(i, j)) == planes.of(seen.at(x, y))) return;
      HALFSPACE_LAW(lines.at(i, j) == style.color ||
                    lines.at(x, y) == style.color);
      capped += seen.at(i, j) >= count;
      clipped_off += planes.of(of_all.at(i, j)) == planes.of(of_all.at(x, y));
    };
    for (std::int32_t j = 0; j < seen.height_px; ++j) {
      for (std::int32_t i = 0; i < seen.width_px; ++i) {
        if (i > 0) check(i, j, i - 1, j);
        if (j > 0) check(i, j, i, j - 1);
      }
    }
  });
  EXPECT_GT(capped, 300u);
  EXPECT_GT(clipped_off, 300u);
}

}  // namespace
}  // namespace halfspace
