#include <vector>

#include "sah/primitive.hpp"

namespace halfspace::fast {
namespace {

/// Numbers of bins, of short lists and of lists from kMany primitives on.
/// Untuned; WAL07 uses 16.
constexpr std::size_t kFewBins = 16;
constexpr std::size_t kMostBins = 32;
constexpr std::size_t kMany = 1024;

/// For each axis, how many primitives begin and end in each bin.
struct Bins {
  std::array<std::array<std::int32_t, kMostBins>, 3> first{};
  std::array<std::array<std::int32_t, kMostBins>, 3> last{};
};

/// A border between two bins of an axis, with its cost.
struct Border {
  double cost = std::numeric_limits<double>::infinity();
  std::size_t bin = 0;  ///< the bin above it
};

/// The probabilities that a ray through a box meets its halves: the ratios of
/// their surfaces to its own (GS87).
struct BoxHalves {
  BoxHalves(const Box& box, std::size_t axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    low = box.low[axis];
    high = box.high[axis];
    const double du = double{box.high[u]} - box.low[u];
    const double dv = double{box.high[v]} - box.low[v];
    ends = du * dv;
    round = du + dv;
    whole = ends + round * (double{high} - low);
  }
  double probability(double length) const {
    // A box without extent in two axes is a line: lengths are in the ratio.
    if (whole > 0) return (ends + round * length) / whole;
    return length / (double{high} - low);
  }
  float low;
  float high;
  double ends;
  double round;
  double whole;
};

class AxisChooser {
 public:
  AxisChooser(const PrimitiveList& list, const Box& box, double cut_weight)
      : list_(list),
        box_(box),
        cut_weight_(cut_weight),
        count_(list.count > kMany ? kMostBins : kFewBins) {}

  AxisSplit choose() {
    fill();
    AxisSplit best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(box_.high[axis] - box_.low[axis] >= 1)) continue;
      const Border border = best_border(axis);
      if (border.bin == 0) continue;
      const AxisSplit found = refined(axis, border);
      if (found.cost.cost < best.cost.cost) best = found;
    }
    return best;
  }

 private:
  void fill() {
    std::array<float, 3> scale;
    for (std::size_t a = 0; a < 3; ++a) {
      const float size = box_.high[a] - box_.low[a];
      scale[a] = size > 0 ? static_cast<float>(count_) / size : 0;
    }
    const auto most = static_cast<std::int32_t>(count_) - 1;
    for (const Primitive& p : list_) {
      for (std::size_t a = 0; a < 3; ++a) {
        const auto from =
            static_cast<std::int32_t>((p.low[a] - box_.low[a]) * scale[a]);
        const auto to =
            static_cast<std::int32_t>((p.high[a] - box_.low[a]) * scale[a]);
        ++bins_.first[a][static_cast<std::size_t>(std::min(from, most))];
        ++bins_.last[a][static_cast<std::size_t>(std::min(to, most))];
      }
    }
  }

  Border best_border(std::size_t axis) const {
    const BoxHalves halves(box_, axis);
    const double width =
        (double{halves.high} - halves.low) / static_cast<double>(count_);
    const auto all = static_cast<double>(list_.count);
    Border best;
    std::int32_t below = 0;
    std::int32_t ended = 0;
    for (std::size_t b = 1; b < count_; ++b) {
      below += bins_.first[axis][b - 1];
      ended += bins_.last[axis][b - 1];
      const double negative = below;
      const double positive = all - ended;
      if (negative == all && positive == all) continue;
      const double length = width * static_cast<double>(b);
      const SplitCost cost =
          cost_of(all, positive, negative,
                  halves.probability(double{halves.high} - halves.low - length),
                  halves.probability(length), cut_weight_);
      if (cost.cost < best.cost) best = {cost.cost, b};
    }
    return best;
  }

  /// The best of the border, rounded to the grid, and some ends of primitives
  /// in the bins beside it.
  AxisSplit refined(std::size_t axis, const Border& border) const {
    constexpr std::size_t kTried = 8;  // untuned
    const float low = box_.low[axis];
    const float high = box_.high[axis];
    const float width = (high - low) / static_cast<float>(count_);
    const float middle = low + width * static_cast<float>(border.bin);
    std::array<float, kTried> tried;
    tried.fill(std::nearbyint(middle));
    std::size_t filled = 1;
    const std::size_t step = 1 + list_.count / 512;
    for (std::size_t i = 0; i < list_.count && filled < kTried; i += step) {
      for (const float end :
           {list_.primitives[i].low[axis], list_.primitives[i].high[axis]}) {
        if (filled == kTried || !(std::abs(end - middle) <= width) ||
            !(low < end && end < high) ||
            std::find(tried.begin(), tried.begin() + filled, end) !=
                tried.begin() + filled) {
          continue;
        }
        tried[filled++] = std::nearbyint(end);
      }
    }
    std::array<std::int32_t, kTried> negative{};
    std::array<std::int32_t, kTried> positive{};
    for (const Primitive& p : list_) {
      for (std::size_t k = 0; k < kTried; ++k) {
        negative[k] += p.low[axis] < tried[k] ? 1 : 0;
        positive[k] += p.high[axis] > tried[k] ? 1 : 0;
      }
    }
    const BoxHalves halves(box_, axis);
    AxisSplit best;
    for (std::size_t k = 0; k < filled; ++k) {
      if (!(low <= tried[k] && tried[k] <= high)) continue;
      // Both lists must be shorter than this one.
      const auto all = static_cast<std::int32_t>(list_.count);
      if (negative[k] == all || positive[k] == all) continue;
      const SplitCost cost =
          cost_of(static_cast<double>(list_.count), positive[k], negative[k],
                  halves.probability(double{high} - tried[k]),
                  halves.probability(double{tried[k]} - low), cut_weight_);
      if (cost.cost < best.cost.cost) best = {cost, axis, tried[k]};
    }
    return best;
  }

  const PrimitiveList& list_;
  const Box& box_;
  double cut_weight_;
  std::size_t count_;
  Bins bins_;
};

}  // namespace

AxisSplit best_axis_split(const PrimitiveList& list, const Box& box,
                          double cut_weight) {
  return AxisChooser(list, box, cut_weight).choose();
}

}  // namespace halfspace::fast
