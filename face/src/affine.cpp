#include "affine.hpp"

#include <algorithm>
#include <cmath>

#include "halfspace/csg/interval.hpp"

namespace halfspace::detail {
namespace {

using csg::area2;
using csg::Integer;

/// A double as mantissa * 2^two, two <= 0.
struct Dyadic {
  Integer mantissa;
  std::int32_t two = 0;
};
Dyadic dyadic_of(double value) {
  const io::Number number = io::number_of(value);
  Dyadic result{
      number.mantissa * pow(Integer(5), static_cast<unsigned>(number.five)),
      number.two};
  if (result.two > 0) {
    result.mantissa <<= result.two;
    result.two = 0;
  }
  return result;
}

/// Whether products with the value keep their digits.
bool is_of_usual_size(double value) {
  const double size = std::abs(value);
  return size == 0 || (size > 0x1p-200 && size < 0x1p200);
}

Bounded cross(const SeenPoint& a, const SeenPoint& b) {
  return a.u * b.v - a.v * b.u;
}
SeenPoint operator-(const SeenPoint& a, const SeenPoint& b) {
  return {a.u - b.u, a.v - b.v};
}

}  // namespace

Weights weights_at(const Triangle& triangle, const csg::ExactPoint& at) {
  // Each area has the product of its corners' denominators; the weight's is
  // the point's in place of its corner's.
  const auto& p = triangle.points;
  Weights weights;
  for (std::size_t k = 0; k < 3; ++k) {
    weights.over[k] =
        area2(p[(k + 1) % 3], p[(k + 2) % 3], at, triangle.axis) * p[k].below;
  }
  weights.below = triangle.area2 * at.below;
  if (weights.below < 0) {
    weights.below = -weights.below;
    for (Integer& weight : weights.over) weight = -weight;
  }
  return weights;
}

double value_of(const Weights& weights, const std::array<double, 3>& values) {
  std::array<Dyadic, 3> dyadic;
  std::int32_t two = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    dyadic[k] = dyadic_of(values[k]);
    two = std::min(two, dyadic[k].two);
  }
  Integer sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    sum += weights.over[k] *
           (dyadic[k].mantissa << static_cast<unsigned>(dyadic[k].two - two));
  }
  return csg::nearest_double(sum, weights.below << static_cast<unsigned>(-two));
}

std::optional<BoundedWeights> weights_at(
    const std::array<SeenPoint, 3>& triangle, const SeenPoint& at) {
  // With p, q, r the corners and x the point: cross(x - p, r - p) and
  // cross(q - p, x - p) over cross(q - p, r - p).
  const SeenPoint second = triangle[1] - triangle[0];
  const SeenPoint third = triangle[2] - triangle[0];
  const Bounded area = cross(second, third);
  if (!is_not_zero(area)) return std::nullopt;
  const SeenPoint x = at - triangle[0];
  return BoundedWeights{cross(x, third) / area, cross(second, x) / area};
}

std::optional<double> value_of(const BoundedWeights& weights,
                               const std::array<double, 3>& values) {
  if (values[0] == values[1] && values[0] == values[2]) return values[0] + 0.0;
  for (const double value : values) {
    if (!is_of_usual_size(value)) return std::nullopt;
  }
  const Bounded value =
      Bounded{values[0]} + (weights.second * exact_sum(values[1], -values[0]) +
                            weights.third * exact_sum(values[2], -values[0]));
  double nearest = 0;
  if (!is_certain(value, nearest)) return std::nullopt;
  return nearest;
}

}  // namespace halfspace::detail
