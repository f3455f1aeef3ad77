#include <vector>

#include "sah/primitive.hpp"

namespace halfspace::fast {
namespace {

constexpr std::size_t kMostBins = 32;
constexpr std::size_t kFewBins = 16;
/// From here on more bins pay.
constexpr std::size_t kManyItems = 1024;

/// For each axis, how many items begin and end in each bin.
struct Bins {
  std::array<std::array<std::int32_t, kMostBins>, 3> first{};
  std::array<std::array<std::int32_t, kMostBins>, 3> last{};
};

/// A border of bins, or a plane in general: of one axis, with its cost.
struct Border {
  double cost = std::numeric_limits<double>::infinity();
  std::size_t bin = 0;  ///< the bin above it
};

/// The chances that a ray through a box meets its halves.
struct Halves {
  Halves(const Box& box, std::size_t axis) {
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
  double chance(double length) const {
    // A list without extent in two axes is a line: all that counts is length.
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
  AxisChooser(const ItemList& list, const Box& box, double cut_weight)
      : list_(list),
        box_(box),
        cut_weight_(cut_weight),
        count_(list.count > kManyItems ? kMostBins : kFewBins) {}

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
    for (const Item& item : list_) {
      for (std::size_t a = 0; a < 3; ++a) {
        const auto from =
            static_cast<std::int32_t>((item.low[a] - box_.low[a]) * scale[a]);
        const auto to =
            static_cast<std::int32_t>((item.high[a] - box_.low[a]) * scale[a]);
        ++bins_.first[a][static_cast<std::size_t>(std::min(from, most))];
        ++bins_.last[a][static_cast<std::size_t>(std::min(to, most))];
      }
    }
  }

  Border best_border(std::size_t axis) const {
    const Halves halves(box_, axis);
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
                  halves.chance(double{halves.high} - halves.low - length),
                  halves.chance(length), cut_weight_);
      if (cost.cost < best.cost) best = {cost.cost, b};
    }
    return best;
  }

  /// The best of the border, rounded to the grid, and some ends of items in the
  /// bins beside it.
  AxisSplit refined(std::size_t axis, const Border& border) const {
    constexpr std::size_t kTried = 8;
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
           {list_.items[i].low[axis], list_.items[i].high[axis]}) {
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
    for (const Item& item : list_) {
      for (std::size_t k = 0; k < kTried; ++k) {
        negative[k] += item.low[axis] < tried[k] ? 1 : 0;
        positive[k] += item.high[axis] > tried[k] ? 1 : 0;
      }
    }
    const Halves halves(box_, axis);
    AxisSplit best;
    for (std::size_t k = 0; k < filled; ++k) {
      if (!(low <= tried[k] && tried[k] <= high)) continue;
      // A plane that leaves one side the whole list gets nowhere.
      const auto all = static_cast<std::int32_t>(list_.count);
      if (negative[k] == all || positive[k] == all) continue;
      const SplitCost cost =
          cost_of(static_cast<double>(list_.count), positive[k], negative[k],
                  halves.chance(double{high} - tried[k]),
                  halves.chance(double{tried[k]} - low), cut_weight_);
      if (cost.cost < best.cost.cost) best = {cost, axis, tried[k]};
    }
    return best;
  }

  const ItemList& list_;
  const Box& box_;
  double cut_weight_;
  std::size_t count_;
  Bins bins_;
};

}  // namespace

AxisSplit best_axis_split(const ItemList& list, const Box& box,
                          double cut_weight) {
  return AxisChooser(list, box, cut_weight).choose();
}

}  // namespace halfspace::fast
