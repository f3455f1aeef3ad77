#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "halfspace/io/figure.hpp"

namespace halfspace::io {
namespace {

/// The ends of strokes that are still to be drawn, in square cells.
class Ends {
 public:
  explicit Ends(const std::vector<FigureStroke>& strokes) : strokes_(strokes) {
    constexpr double kMost = std::numeric_limits<double>::max();
    FigurePoint low = {kMost, kMost};
    FigurePoint high = {-kMost, -kMost};
    for (const FigureStroke& stroke : strokes) {
      for (const FigurePoint& p : {stroke.from, stroke.to}) {
        low = {std::min(low[0], p[0]), std::min(low[1], p[1])};
        high = {std::max(high[0], p[0]), std::max(high[1], p[1])};
      }
    }
    low_ = low;
    const double across = std::max(high[0] - low[0], high[1] - low[1]);
    side_ = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(
               std::sqrt(static_cast<double>(strokes.size()))));
    cell_ = across > 0 ? across / static_cast<double>(side_) : 1;
    ++side_;
    cells_.resize(static_cast<std::size_t>(side_ * side_));
    for (std::size_t k = strokes.size(); k-- > 0;) {
      cell_of(strokes[k].from).push_back({k, false});
      cell_of(strokes[k].to).push_back({k, true});
    }
  }

  /// The nearest end of a stroke that is not `drawn`, with the stroke's number
  /// and whether it is its last end. Requires: there is one.
  std::pair<std::size_t, bool> nearest(const FigurePoint& p,
                                       const std::vector<bool>& drawn) {
    const std::int64_t x = column(p[0], 0);
    const std::int64_t y = column(p[1], 1);
    double best = std::numeric_limits<double>::max();
    std::pair<std::size_t, bool> found{0, false};
    for (std::int64_t ring = 0; ring <= side_; ++ring) {
      // What is in the rings from here on is farther than so many cells.
      const double least = static_cast<double>(ring - 1) * cell_;
      if (ring > 0 && best <= least * least) break;
      for (std::int64_t j = std::max<std::int64_t>(0, y - ring);
           j <= std::min(side_ - 1, y + ring); ++j) {
        const bool whole = j == y - ring || j == y + ring;
        const std::int64_t step = whole || ring == 0 ? 1 : 2 * ring;
        for (std::int64_t i = x - ring; i <= x + ring; i += step) {
          if (i < 0 || i >= side_) continue;
          look(cells_[static_cast<std::size_t>(j * side_ + i)], p, drawn, best,
               found);
        }
      }
    }
    return found;
  }

 private:
  using Cell = std::vector<std::pair<std::size_t, bool>>;

  void look(Cell& cell, const FigurePoint& p, const std::vector<bool>& drawn,
            double& best, std::pair<std::size_t, bool>& found) const {
    std::erase_if(cell, [&](const auto& end) { return drawn[end.first]; });
    for (const auto& end : cell) {
      const FigureStroke& stroke = strokes_[end.first];
      const FigurePoint& q = end.second ? stroke.to : stroke.from;
      const double x = q[0] - p[0];
      const double y = q[1] - p[1];
      const double distance = x * x + y * y;
      if (distance > best || (distance == best && end >= found)) continue;
      best = distance;
      found = end;
    }
  }

  std::int64_t column(double value, std::size_t axis) const {
    return std::clamp<std::int64_t>(
        static_cast<std::int64_t>((value - low_[axis]) / cell_), 0, side_ - 1);
  }
  Cell& cell_of(const FigurePoint& p) {
    return cells_[static_cast<std::size_t>(column(p[1], 1) * side_ +
                                           column(p[0], 0))];
  }

  const std::vector<FigureStroke>& strokes_;
  FigurePoint low_{};
  double cell_ = 1;
  std::int64_t side_ = 1;
  std::vector<Cell> cells_;
};

}  // namespace

void order_for_pen(std::vector<FigureStroke>& strokes) {
  if (strokes.empty()) return;
  Ends ends(strokes);
  std::vector<bool> drawn(strokes.size());
  std::vector<FigureStroke> ordered;
  std::pair<std::size_t, bool> next{0, false};
  while (true) {
    FigureStroke stroke = strokes[next.first];
    drawn[next.first] = true;
    if (next.second) std::swap(stroke.from, stroke.to);
    const FigurePoint pen = stroke.to;
    ordered.push_back(std::move(stroke));
    if (ordered.size() == strokes.size()) break;
    next = ends.nearest(pen, drawn);
  }
  strokes = std::move(ordered);
}

std::vector<FigureStroke> hatching(const FigureRegion& region, double gap) {
  // Along x + y; strokes are where x - y is a multiple of the gap's diagonal.
  const double step = gap * std::sqrt(2.0);
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const auto& loop : region.loops) {
    for (const FigurePoint& p : loop) {
      low = std::min(low, p[0] + p[1]);
      high = std::max(high, p[0] + p[1]);
    }
  }
  std::vector<FigureStroke> strokes;
  for (double sum = (std::floor(low / step) + 0.5) * step; sum < high;
       sum += step) {
    std::vector<FigurePoint> crossings;
    for (const auto& loop : region.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const FigurePoint& p = loop[k];
        const FigurePoint& q = loop[k + 1 == loop.size() ? 0 : k + 1];
        const double f = p[0] + p[1] - sum;
        const double g = q[0] + q[1] - sum;
        if ((f < 0) == (g < 0)) continue;
        const double share = f / (f - g);
        crossings.push_back(
            {p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])});
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      strokes.push_back({crossings[k], crossings[k + 1], {}});
  }
  return strokes;
}

}  // namespace halfspace::io
