#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "box/box.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace::fast {

/// A polygon, or a part of one, while the tree is built (a primitive in ray
/// tracing): its box, rounded outwards, relative to the frame's origin.
struct Primitive {
  std::array<float, 3> low;
  PolygonId source;
  std::array<float, 3> high;
  std::int32_t part;  ///< index of the part, or kWholePolygon
};
static_assert(sizeof(Primitive) == 32);

constexpr std::int32_t kWholePolygon = -1;

/// The greatest float up to `value`, and the least from it on.
inline float float_below(double value) {
  const auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) <= value) return nearest;
  return std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}
inline float float_above(double value) { return -float_below(-value); }

inline void extend(Box& box, const Primitive& primitive) {
  for (std::size_t a = 0; a < 3; ++a) {
    box.low[a] = std::min(box.low[a], primitive.low[a]);
    box.high[a] = std::max(box.high[a], primitive.high[a]);
  }
}

/// Half the surface of a box with these edges.
inline double half_surface(double x, double y, double z) {
  return x * y + y * z + z * x;
}

/// A list to be divided.
struct PrimitiveList {
  const Primitive* primitives;
  std::size_t count;
  const Primitive* begin() const { return primitives; }
  const Primitive* end() const { return primitives + count; }
};

/// How good a plane is for a list, by the surface area heuristic (GS87, MB90).
struct SplitCost {
  /// Expected number of fragments that a ray through the list's box meets. An
  /// undivided list costs the number of its primitives.
  double cost = std::numeric_limits<double>::infinity();
  double cuts = 0;  ///< primitives that the plane cuts, estimated
};

/// A plane across an axis, relative to the frame's origin.
struct AxisSplit {
  SplitCost cost;
  std::size_t axis = 0;
  float coordinate = 0;  ///< an integer
};

/// The share of a child's cost that is saved where its sibling hides it. With
/// 1 flat stacks would not be divided at all. Untuned.
constexpr double kHiddenShare = 0.3;

/// The cost of a plane that divides a list of `count` primitives into two lists
/// that a ray through its box meets with the given probabilities.
inline SplitCost cost_of(double count, double positive, double negative,
                         double positive_probability,
                         double negative_probability, double cut_weight) {
  const double both = positive + negative;
  const double cuts = std::max(0.0, both - count);
  const double met =
      positive * positive_probability + negative * negative_probability;
  const double hidden = positive * negative *
                        (positive_probability + negative_probability) *
                        kHiddenShare;
  return {met - (both > 0 ? hidden / both : 0) + cut_weight * cuts, cuts};
}

/// The best plane across an axis: by bins first (WAL07), then among the ends of
/// primitives near the best bins' borders, where planes separate the rows of a
/// regular mesh without cuts.
///
/// Cost: linear.
AxisSplit best_axis_split(const PrimitiveList& list, const Box& box,
                          double cut_weight);

}  // namespace halfspace::fast
