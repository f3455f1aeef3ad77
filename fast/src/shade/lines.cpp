#include "halfspace/fast/shade/lines.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "exact/big_rational.hpp"
#include "exact/filter.hpp"
#include "halfspace/assert.hpp"
#include "shade/exact_double.hpp"

namespace halfspace::fast {
namespace {

/// Which samples of each pixel are on a line: a bit each.
using LineMasks = Grid2<std::uint64_t>;

/// The nearest point of a stroke to an image point: an end or the foot of the
/// perpendicular; and whether the point is within the half width.
enum class OnLine : std::uint8_t { kNo, kYes, kUnknown };

/// All sizes of differences here are at most `size`, so with coordinates that
/// are exact each is off by u size, products by 3u size^2, and sums and
/// differences of two of them by 8u size^2. Then the square of the cross
/// product is off by 2 size^2 8u size^2 and its own rounding, and the square of
/// the half width, which is exact, times that of the length by 10u half^2
/// size^2.
OnLine is_near(double x, double y, const Stroke& s, double half) {
  const double dx = s.to.x - s.from.x;
  const double dy = s.to.y - s.from.y;
  const double ex = x - s.from.x;
  const double ey = y - s.from.y;
  const double size = std::abs(dx) + std::abs(dy) + std::abs(ex) + std::abs(ey);
  const double doubt = 16 * kRounding * size * size;
  const double length = dx * dx + dy * dy;
  const double at = ex * dx + ey * dy;
  const auto decided = [](double value, double limit, double error) {
    if (value < limit - error) return OnLine::kYes;
    return value > limit + error ? OnLine::kNo : OnLine::kUnknown;
  };
  if (at < -doubt) return decided(ex * ex + ey * ey, half * half, doubt);
  if (at > length + doubt) {
    const double fx = x - s.to.x;
    const double fy = y - s.to.y;
    return decided(fx * fx + fy * fy, half * half, 4 * doubt);
  }
  if (!(at > doubt && at < length - doubt)) return OnLine::kUnknown;
  const double cross = ex * dy - ey * dx;
  return decided(cross * cross, half * half * length,
                 3 * doubt * (size * size + half * half));
}

bool is_exactly_near(double x, double y, const Stroke& s, std::int32_t width) {
  const auto exact = [](double value) { return exact_double(value); };
  const BigRational half = BigRational(width) / 32;
  const BigRational dx = exact(s.to.x) - exact(s.from.x);
  const BigRational dy = exact(s.to.y) - exact(s.from.y);
  const BigRational ex = exact(x) - exact(s.from.x);
  const BigRational ey = exact(y) - exact(s.from.y);
  const BigRational length = dx * dx + dy * dy;
  const BigRational at = ex * dx + ey * dy;
  if (at <= 0) return ex * ex + ey * ey <= half * half;
  if (at >= length) {
    const BigRational fx = exact(x) - exact(s.to.x);
    const BigRational fy = exact(y) - exact(s.to.y);
    return fx * fx + fy * fy <= half * half;
  }
  const BigRational cross = ex * dy - ey * dx;
  return cross * cross <= half * half * length;
}

/// Marks the samples on one line after the other.
class LineMarker {
 public:
  LineMarker(const LineStyle& style, const LineOptions& how, LineMasks& masks)
      : width_(style.width),
        half_(style.width / 32.0),
        how_(how),
        masks_(masks) {}

  void mark(const Stroke& stroke) {
    const double n = how_.samples;
    // Rows and columns of samples, from the image's corner on; one more on
    // either side for what rounding may have cost.
    const auto index = [&](double at, double corner) {
      return (at - corner) * n - 0.5;
    };
    const auto [low, high] = std::minmax(stroke.from.y, stroke.to.y);
    const auto first = bounded(index(low - half_, how_.top) - 1,
                               masks_.height_px * how_.samples);
    const auto end = bounded(index(high + half_, how_.top) + 2,
                             masks_.height_px * how_.samples);
    for (std::int32_t row = first; row < end; ++row) {
      const double y = how_.top + (row + 0.5) / n;
      const auto [left, right] = columns_near(stroke, y);
      const auto from =
          bounded(index(left, how_.left) - 1, masks_.width_px * how_.samples);
      const auto to =
          bounded(index(right, how_.left) + 2, masks_.width_px * how_.samples);
      for (std::int32_t column = from; column < to; ++column)
        mark_sample(stroke, column, row, how_.left + (column + 0.5) / n, y);
    }
  }

  const FilterStats& stats() const { return stats_; }

 private:
  static std::int32_t bounded(double value, std::int32_t most) {
    return static_cast<std::int32_t>(
        std::clamp(std::floor(value), 0.0, double{static_cast<double>(most)}));
  }

  /// How far points of the line in that row can lie to the left and right: the
  /// part of the stroke within the half width above and below, and the half
  /// width beside it.
  std::pair<double, double> columns_near(const Stroke& s, double y) const {
    double left = std::min(s.from.x, s.to.x);
    double right = std::max(s.from.x, s.to.x);
    const double dy = s.to.y - s.from.y;
    if (std::abs(dy) > 1e-6) {
      const double slope = (s.to.x - s.from.x) / dy;
      const double a = s.from.x + slope * (y - half_ - s.from.y);
      const double b = s.from.x + slope * (y + half_ - s.from.y);
      left = std::max(left, std::min(a, b) - 0.5);
      right = std::min(right, std::max(a, b) + 0.5);
    }
    return {left - half_, right + half_};
  }

  void mark_sample(const Stroke& stroke, std::int32_t column, std::int32_t row,
                   double x, double y) {
    const std::int32_t n = how_.samples;
    std::uint64_t& mask = masks_.at(column / n, row / n);
    const std::uint64_t bit = std::uint64_t{1} << (row % n * n + column % n);
    if ((mask & bit) != 0) return;
    OnLine on = is_near(x, y, stroke, half_);
    if (on == OnLine::kUnknown) {
      ++stats_.exact;
      on = is_exactly_near(x, y, stroke, width_) ? OnLine::kYes : OnLine::kNo;
    } else {
      ++stats_.filtered;
    }
    if (on == OnLine::kYes) mask |= bit;
  }

  std::int32_t width_;
  double half_;
  const LineOptions& how_;
  LineMasks& masks_;
  FilterStats stats_;
};

}  // namespace

FilterStats add_lines(const Drawing& drawing, const LineStyle& style,
                      const LineOptions& how, ColorImage& image) {
  HALFSPACE_ASSERT(how.samples == 1 || how.samples == 2 || how.samples == 4 ||
                   how.samples == 8);
  HALFSPACE_ASSERT(style.width >= 1 && style.width <= kMostLineWidth);
  LineMasks masks(image.width_px, image.height_px, 0);
  LineMarker marker(style, how, masks);
  for (const Stroke& stroke : drawing.strokes) {
    if (stroke.layers == 0 && (style.classes & set_of(stroke.edge_class)) != 0)
      marker.mark(stroke);
  }
  const int count = how.samples * how.samples;
  for (std::size_t k = 0; k < masks.pixels.size(); ++k) {
    if (masks.pixels[k] == 0) continue;
    image.pixels[k] = with_line(image.pixels[k], style.color,
                                std::popcount(masks.pixels[k]), count);
  }
  return marker.stats();
}

}  // namespace halfspace::fast
