#include "figure/shading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "figure/writers.hpp"

namespace halfspace::io {
namespace {

using Channels = std::array<double, 3>;

constexpr double kBeyondFigures = std::numeric_limits<double>::max();

double value_of(const std::array<double, 3>& form, const FigurePoint& p) {
  return form[0] * p[0] + form[1] * p[1] + form[2];
}

FigurePoint between(const FigurePoint& p, const FigurePoint& q, double share) {
  return {p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])};
}

/// The slopes of a shade's channels at a point.
std::array<FigurePoint, 3> slopes_at(const FigureShade& shade,
                                     const FigurePoint& p) {
  const Channels color = shade.at(p);
  const double total = value_of(shade.forms[3], p);
  std::array<FigurePoint, 3> slopes;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t a = 0; a < 2; ++a) {
      slopes[c][a] = (shade.forms[c][a] - color[c] * shade.forms[3][a]) / total;
    }
  }
  return slopes;
}

/// The direction in which the colour changes most: the eigenvector of the sum
/// of the slopes' squares, of length 1; (1, 0) if it does not change.
FigurePoint steepest(const std::array<FigurePoint, 3>& slopes) {
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (const FigurePoint& slope : slopes) {
    xx += slope[0] * slope[0];
    xy += slope[0] * slope[1];
    yy += slope[1] * slope[1];
  }
  const double angle = std::atan2(2 * xy, xx - yy) / 2;
  return {std::cos(angle), std::sin(angle)};
}

double least_total(const FigureShade& shade, const FigureLoops& loops) {
  double least = kBeyondFigures;
  for (const auto& loop : loops) {
    for (const FigurePoint& p : loop)
      least = std::min(least, value_of(shade.forms[3], p));
  }
  return least;
}

double farthest(const Channels& color, const Channels& other) {
  double most = 0;
  for (std::size_t c = 0; c < 3; ++c)
    most = std::max(most, std::abs(color[c] - other[c]));
  return most;
}

Channels channels_of(Rgb color) {
  return {double(color.r), double(color.g), double(color.b)};
}

/// Cuts one region into parts.
class ShadeCutter {
 public:
  ShadeCutter(const FigureShade& shade, double levels, bool gradients)
      : shade_(shade), levels_(levels), gradients_(gradients) {}

  std::vector<ShadePart> run(const FigureLoops& loops) {
    std::vector<std::pair<FigureLoops, int>> work = {{loops, 0}};
    std::vector<ShadePart> parts;
    while (!work.empty()) {
      auto [part, depth] = std::move(work.back());
      work.pop_back();
      if (part.empty()) continue;
      ShadePart made;
      const std::optional<Cut> cut = make(part, made);
      if (cut && depth < kDeepest) {
        for (const bool below : {false, true}) {
          work.emplace_back(
              cut_loops(part, {cut->across[0], cut->across[1], -cut->at},
                        below),
              depth + 1);
        }
        continue;
      }
      made.loops = std::move(part);
      parts.push_back(std::move(made));
    }
    return parts;
  }

 private:
  /// Each cut halves the range of the colours in one of two directions, of
  /// which neither begins with more than 2^8 / levels in size: what is cut more
  /// often is as small as the doubles' own steps.
  static constexpr int kDeepest = 40;

  /// Where to cut: at `across . p = at`.
  struct Cut {
    FigurePoint across{};
    double at = 0;
  };
  struct Range {
    double low = kBeyondFigures;
    double high = -kBeyondFigures;
    double size() const { return high - low; }
    double middle() const { return (low + high) / 2; }
  };

  static Range range_of(const FigureLoops& loops, const FigurePoint& along) {
    Range range;
    for (const auto& loop : loops) {
      for (const FigurePoint& p : loop) {
        const double at = along[0] * p[0] + along[1] * p[1];
        range = {std::min(range.low, at), std::max(range.high, at)};
      }
    }
    return range;
  }

  /// Makes a part, or tells where to cut it first.
  std::optional<Cut> make(const FigureLoops& loops, ShadePart& part) const {
    const FigurePoint middle = inner_point(loops);
    const auto slopes = slopes_at(shade_, middle);
    const FigurePoint along = steepest(slopes);
    const FigurePoint across = {-along[1], along[0]};
    const Range length = range_of(loops, along);
    const Range breadth = range_of(loops, across);
    const Channels color = shade_.at(middle);
    part.fill = rounded_color(color);
    if (error_of_one(loops, part.fill) <= levels_) return std::nullopt;
    double change = 0;
    double drift = 0;
    for (const FigurePoint& slope : slopes) {
      const auto by = [&](const FigurePoint& d) {
        return std::abs(slope[0] * d[0] + slope[1] * d[1]);
      };
      change = std::max(change, by(along) * length.size());
      drift = std::max(drift, by(across) * breadth.size());
    }
    const Cut shorter = {along, length.middle()};
    const Cut narrower = {across, breadth.middle()};
    if (!gradients_) return change >= drift ? shorter : narrower;
    const double from = along[0] * middle[0] + along[1] * middle[1];
    for (std::size_t end = 0; end < 2; ++end) {
      const double at = (end == 0 ? length.low : length.high) - from;
      part.line[end] = {middle[0] + at * along[0], middle[1] + at * along[1]};
      Channels there;
      for (std::size_t c = 0; c < 3; ++c) {
        there[c] =
            color[c] + at * (slopes[c][0] * along[0] + slopes[c][1] * along[1]);
      }
      part.ends[end] = rounded_color(there);
    }
    const double corners = error_of_gradient(loops, part, length.size());
    const double radius = std::hypot(length.size(), breadth.size()) / 2;
    const double inside = bulge(loops, part, radius, length.size());
    part.has_gradient = corners + inside <= levels_;
    if (part.has_gradient) return std::nullopt;
    // What the gradient does not follow changes across it, but for the bulge,
    // which goes with the radius, and what its ends are rounded by.
    const bool is_bulging = inside > levels_ / 4;
    if (drift > levels_ || (is_bulging && breadth.size() > length.size()))
      return narrower;
    return change >= 1 || is_bulging ? shorter : narrower;
  }

  /// The mean of the corners, at which the last form is positive, too.
  static FigurePoint inner_point(const FigureLoops& loops) {
    FigurePoint sum = {0, 0};
    double count = 0;
    for (const auto& loop : loops) {
      for (const FigurePoint& p : loop) {
        sum = {sum[0] + p[0], sum[1] + p[1]};
        ++count;
      }
    }
    return {sum[0] / count, sum[1] / count};
  }

  double error_of_one(const FigureLoops& loops, Rgb color) const {
    double most = 0;
    for (const auto& loop : loops) {
      for (const FigurePoint& p : loop)
        most = std::max(most, farthest(shade_.at(p), channels_of(color)));
    }
    return most;
  }

  double error_of_gradient(const FigureLoops& loops, const ShadePart& part,
                           double length) const {
    const Channels first = channels_of(part.ends[0]);
    const Channels last = channels_of(part.ends[1]);
    const double least = least_total(shade_, loops);
    double most = 0;
    for (const auto& loop : loops) {
      for (const FigurePoint& p : loop) {
        const double share =
            ((p[0] - part.line[0][0]) * (part.line[1][0] - part.line[0][0]) +
             (p[1] - part.line[0][1]) * (part.line[1][1] - part.line[0][1])) /
            (length * length);
        Channels there;
        for (std::size_t c = 0; c < 3; ++c)
          there[c] = first[c] + share * (last[c] - first[c]);
        // The numerator at the corner over the least divisor anywhere.
        most = std::max(most, farthest(shade_.at(p), there) *
                                  value_of(shade_.forms[3], p) / least);
      }
    }
    return most;
  }

  double bulge(const FigureLoops& loops, const ShadePart& part, double radius,
               double length) const {
    const double steepness =
        farthest(channels_of(part.ends[0]), channels_of(part.ends[1])) / length;
    return steepness * std::hypot(shade_.forms[3][0], shade_.forms[3][1]) *
           radius * radius / least_total(shade_, loops);
  }

  const FigureShade& shade_;
  double levels_;
  bool gradients_;
};

/// Whether a loop is convex, as far as doubles tell.
bool is_convex(const std::vector<FigurePoint>& loop) {
  const std::size_t n = loop.size();
  for (std::size_t k = 0; k < n; ++k) {
    const FigurePoint& p = loop[k];
    const FigurePoint& q = loop[(k + 1) % n];
    const FigurePoint& r = loop[(k + 2) % n];
    if ((q[0] - p[0]) * (r[1] - q[1]) < (q[1] - p[1]) * (r[0] - q[0]))
      return false;
  }
  return true;
}

/// Loops as trapezoids between the heights of their corners, as triangles.
void cut_in_slabs(const FigureLoops& loops,
                  std::vector<ShadeTriangle>& triangles) {
  struct Side {
    FigurePoint top, bottom;
    double x_at(double y) const {
      return top[0] +
             (y - top[1]) / (bottom[1] - top[1]) * (bottom[0] - top[0]);
    }
  };
  std::vector<Side> sides;
  std::vector<double> heights;
  for (const auto& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Side side = {loop[k], loop[k + 1 == loop.size() ? 0 : k + 1]};
      heights.push_back(side.top[1]);
      if (side.top[1] > side.bottom[1]) std::swap(side.top, side.bottom);
      if (side.top[1] < side.bottom[1]) sides.push_back(side);
    }
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  for (std::size_t h = 0; h + 1 < heights.size(); ++h) {
    const double y0 = heights[h];
    const double y1 = heights[h + 1];
    std::vector<std::array<double, 2>> crossings;
    for (const Side& side : sides) {
      if (side.top[1] <= y0 && side.bottom[1] >= y1)
        crossings.push_back({side.x_at(y0), side.x_at(y1)});
    }
    std::sort(
        crossings.begin(), crossings.end(),
        [](const auto& f, const auto& g) { return f[0] + f[1] < g[0] + g[1]; });
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const auto& [a, b] = crossings[k];
      const auto& [c, d] = crossings[k + 1];
      if (c > a) triangles.push_back({{{a, y0}, {c, y0}, {b, y1}}});
      if (d > b) triangles.push_back({{{c, y0}, {d, y1}, {b, y1}}});
    }
  }
}

}  // namespace

Channels FigureShade::at(const FigurePoint& p) const {
  const double total = value_of(forms[3], p);
  return {value_of(forms[0], p) / total, value_of(forms[1], p) / total,
          value_of(forms[2], p) / total};
}

Rgb rounded_color(const Channels& channels) {
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(
        std::lround(std::clamp(value, 0.0, 255.0)));
  };
  return {byte(channels[0]), byte(channels[1]), byte(channels[2])};
}

FigureLoops cut_loops(const FigureLoops& loops,
                      const std::array<double, 3>& line, bool below) {
  FigureLoops result;
  for (const auto& loop : loops) {
    std::vector<FigurePoint> kept;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const FigurePoint& p = loop[k];
      const FigurePoint& q = loop[k + 1 == loop.size() ? 0 : k + 1];
      const double f = value_of(line, p);
      const double g = value_of(line, q);
      if ((f < 0) == below) kept.push_back(p);
      if ((f < 0) != (g < 0)) {
        // Seen from either end it is the same point.
        kept.push_back(f < 0 ? between(p, q, f / (f - g))
                             : between(q, p, g / (g - f)));
      }
    }
    if (kept.size() > 2) result.push_back(std::move(kept));
  }
  return result;
}

std::vector<ShadePart> shade_parts(const FigureRegion& region, double levels,
                                   bool gradients) {
  return ShadeCutter(*region.shade, levels, gradients).run(region.loops);
}

std::vector<ShadeTriangle> shade_triangles(const FigureRegion& region,
                                           double levels) {
  const FigureShade& shade = *region.shade;
  std::vector<ShadeTriangle> work;
  if (region.loops.size() == 1 && is_convex(region.loops[0])) {
    const auto& loop = region.loops[0];
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      work.push_back({loop[0], loop[k], loop[k + 1]});
  } else {
    cut_in_slabs(region.loops, work);
  }
  std::vector<ShadeTriangle> triangles;
  while (!work.empty()) {
    const ShadeTriangle t = work.back();
    work.pop_back();
    // Interpolated, the colour is right at the corners. Between them, at the
    // weights w, the numerator N - L D is the sum of w_i w_j (C_i - C_j)
    // (D_i - D_j) over pairs of corners, and the products w_i w_j add up to a
    // third at most.
    std::array<double, 3> sides;
    double bulge = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const FigurePoint& p = t[k];
      const FigurePoint& q = t[(k + 1) % 3];
      sides[k] = std::hypot(q[0] - p[0], q[1] - p[1]);
      bulge = std::max(bulge, farthest(shade.at(p), shade.at(q)) *
                                  std::abs(value_of(shade.forms[3], p) -
                                           value_of(shade.forms[3], q)) /
                                  3);
    }
    const double longest = *std::max_element(sides.begin(), sides.end());
    const FigureLoops loops = {{t[0], t[1], t[2]}};
    if (bulge <= levels * least_total(shade, loops) || longest < 1e-3) {
      triangles.push_back(t);
      continue;
    }
    const auto k = static_cast<std::size_t>(
        std::max_element(sides.begin(), sides.end()) - sides.begin());
    const FigurePoint half = between(t[k], t[(k + 1) % 3], 0.5);
    work.push_back({t[k], half, t[(k + 2) % 3]});
    work.push_back({half, t[(k + 1) % 3], t[(k + 2) % 3]});
  }
  std::reverse(triangles.begin(), triangles.end());
  return triangles;
}

Figure in_flat_parts(const Figure& figure, double levels) {
  Figure result = figure;
  result.regions.clear();
  for (const FigureRegion& region : figure.regions) {
    if (!region.shade) {
      result.regions.push_back(region);
      continue;
    }
    for (ShadePart& part : shade_parts(region, levels, false)) {
      FigureRegion flat;
      flat.loops = std::move(part.loops);
      flat.fill = part.fill;
      flat.is_background = region.is_background;
      result.regions.push_back(std::move(flat));
    }
  }
  return result;
}

}  // namespace halfspace::io
