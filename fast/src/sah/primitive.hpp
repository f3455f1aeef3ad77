#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "halfspace/fast/build.hpp"

namespace halfspace::fast {

/// What is known of a polygon or a part of one on its way down a tree for
/// display: its box, rounded outwards, relative to the frame's origin.
struct Item {
  std::array<float, 3> low;
  PolygonId source;
  std::array<float, 3> high;
  std::int32_t part;  ///< which part, or kWhole
};
static_assert(sizeof(Item) == 32);

constexpr std::int32_t kWhole = -1;

/// The greatest float up to `value`, and the least from it on.
inline float below(double value) {
  const auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) <= value) return nearest;
  return std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}
inline float above(double value) { return -below(-value); }

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The box of nothing.
constexpr Box kNoBox = {{kInfinity, kInfinity, kInfinity},
                        {-kInfinity, -kInfinity, -kInfinity}};

inline void include(Box& box, const Item& item) {
  for (std::size_t a = 0; a < 3; ++a) {
    box.low[a] = std::min(box.low[a], item.low[a]);
    box.high[a] = std::max(box.high[a], item.high[a]);
  }
}

/// Half the surface of a box with these edges.
inline double half_surface(double x, double y, double z) {
  return x * y + y * z + z * x;
}

/// A list to be divided.
struct ItemList {
  const Item* items;
  std::size_t count;
  const Item* begin() const { return items; }
  const Item* end() const { return items + count; }
};

/// How good a plane is for a list.
struct SplitCost {
  /// Fragments that a ray through the list's box has to pay for; the list
  /// itself, undivided, costs the number of its items.
  double cost = std::numeric_limits<double>::infinity();
  double cuts = 0;  ///< items that the plane cuts, about
};

/// A plane across an axis, relative to the frame's origin.
struct AxisSplit {
  SplitCost cost;
  std::size_t axis = 0;
  float coordinate = 0;  ///< an integer
};

/// How much less is paid for a child because its sibling, if that has all the
/// rest, hides it: 0 would make dividing flat stacks worthless.
constexpr double kHidden = 0.3;

/// The cost of a plane that divides a list of `count` items into two lists
/// that a ray through its box meets with the given probabilities.
inline SplitCost cost_of(double count, double positive, double negative,
                         double positive_chance, double negative_chance,
                         double cut_weight) {
  const double both = positive + negative;
  const double cuts = std::max(0.0, both - count);
  const double met = positive * positive_chance + negative * negative_chance;
  const double hidden =
      positive * negative * (positive_chance + negative_chance) * kHidden;
  return {met - (both > 0 ? hidden / both : 0) + cut_weight * cuts, cuts};
}

/// The best plane across an axis: by bins first, then among the ends of items
/// near the best bins' borders, where meshes in rows come apart without cuts.
///
/// Cost: linear.
AxisSplit best_axis_split(const ItemList& list, const Box& box,
                          double cut_weight);

}  // namespace halfspace::fast
