#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <charconv>
#include <cmath>
#include <string>

#include "halfspace/io/color_map.hpp"

namespace halfspace::io {
namespace {

/// Wide enough for what the nearest double is decided by; the same on every
/// machine.
using WideFloat = boost::multiprecision::cpp_bin_float_50;

constexpr std::int32_t kMostSteps = 4096;

double bound_of(const ScaleRange& range, std::int32_t k, std::int32_t n) {
  const WideFloat low = range.low;
  const WideFloat high = range.high;
  const WideFloat share = WideFloat(k) / n;
  if (range.logarithmic) {
    return WideFloat(low * pow(WideFloat(high / low), share))
        .convert_to<double>();
  }
  return WideFloat(low + (high - low) * share).convert_to<double>();
}

Error range_error(const std::string& what) {
  return {ErrorCode::kOutOfRange, what};
}

std::string to_short_text(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value,
                                 std::chars_format::general, 6);
  return std::string(text, end.ptr);
}

/// The part of the way from low to high at which a number stands.
double share_of(const ScaleRange& range, double value) {
  if (!range.logarithmic) return (value - range.low) / (range.high - range.low);
  return std::log(value / range.low) / std::log(range.high / range.low);
}

void add_mark(const ScaleRange& range, double value,
              std::vector<ScaleMark>& marks) {
  const double share = share_of(range, value);
  if (share < -1e-9 || share > 1 + 1e-9) return;
  if (std::abs(value) < 1e-9 * (range.high - range.low) && !range.logarithmic)
    value = 0;
  marks.push_back({value, std::clamp(share, 0.0, 1.0), to_short_text(value)});
}

/// All multiples of the least of 1, 2, 5, 10, 20 ... that are few enough.
std::vector<ScaleMark> even_marks(const ScaleRange& range, int most) {
  const double span = range.high - range.low;
  const double least = span / std::max(1, most);
  const double power = std::pow(10, std::floor(std::log10(least)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= least * (1 - 1e-9)) step = factor * power;
  }
  std::vector<ScaleMark> marks;
  const double first = std::ceil(range.low / step - 1e-9);
  for (double k = first; k * step <= range.high + 1e-9 * span; k += 1) {
    add_mark(range, k * step, marks);
    if (marks.size() > 100) break;
  }
  return marks;
}

std::vector<ScaleMark> log_marks(const ScaleRange& range, int most) {
  const double first = std::floor(std::log10(range.low));
  const double last = std::ceil(std::log10(range.high));
  const double decades = std::log10(range.high / range.low);
  if (decades < 1) return even_marks(range, most);
  const bool is_sparse = 3 * decades <= most;
  const double every = std::ceil(decades / std::max(1, most));
  std::vector<ScaleMark> marks;
  for (double e = first; e <= last; e += every) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor == 1 || is_sparse)
        add_mark(range, factor * std::pow(10, e), marks);
    }
  }
  return marks;
}

}  // namespace

Result<ColorScale> make_scale(const ColorMap& map, const ScaleRange& range) {
  if (!std::isfinite(range.low) || !std::isfinite(range.high)) {
    return Error{ErrorCode::kNotFinite, "the range of a scale is not finite"};
  }
  if (!(range.low < range.high)) {
    return range_error("the range of a scale begins at " +
                       to_short_text(range.low) + ", not below its end, " +
                       to_short_text(range.high));
  }
  if (range.logarithmic && !(range.low > 0)) {
    return range_error("a logarithmic scale begins above 0, not at " +
                       to_short_text(range.low));
  }
  if (range.steps != 0 && (range.steps < 2 || range.steps > kMostSteps))
    return range_error("a scale has 2 to 4096 steps");
  const auto colors = static_cast<std::int32_t>(map.size());
  const std::int32_t n = range.steps != 0 ? range.steps : colors;
  ColorScale scale;
  scale.colors.clear();
  scale.no_data = range.no_data;
  if (!range.clamp)
    scale.limits = ScaleLimits{range.low, range.high, range.no_data};
  for (std::int32_t k = 0; k < n; ++k) {
    const Rgb color = map[static_cast<std::size_t>(
        (std::int64_t{2 * k + 1} * colors) / (std::int64_t{2} * n))];
    const double bound = k == 0 ? range.low : bound_of(range, k, n);
    if (k > 0) {
      const double before =
          scale.steps.empty() ? range.low : scale.steps.back();
      if (!(before < bound) || bound > range.high) continue;
      scale.steps.push_back(bound);
    }
    scale.colors.push_back(color);
  }
  return scale;
}

std::vector<ScaleMark> scale_marks(const ScaleRange& range, int most) {
  return range.logarithmic ? log_marks(range, most) : even_marks(range, most);
}

}  // namespace halfspace::io
