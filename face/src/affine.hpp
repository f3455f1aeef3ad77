#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "bounded.hpp"
#include "halfspace/csg/surface.hpp"

namespace halfspace::detail {

/// The affine function over a triangle that has given values at its corners,
/// as seen along an axis, at a point of its plane or near it: exactly, and
/// rounded once. No value is -0.
struct Triangle {
  std::array<csg::ExactPoint, 3> points;
  std::size_t axis = 0;
  csg::Integer area2;  ///< as area2() has it; not 0
};

/// The values' weights at a point, each times below, a common denominator.
struct Weights {
  std::array<csg::Integer, 3> over;
  csg::Integer below;
};
Weights weights_at(const Triangle& triangle, const csg::ExactPoint& at);
/// Requires: the values are finite.
double value_of(const Weights& weights, const std::array<double, 3>& values);

/// The same in doubles with bounds (see Bounded): a value, or nothing where the
/// bounds do not tell which double is the nearest one.
struct SeenPoint {
  Bounded u, v;  ///< the coordinates after the axis, in that order
};
/// The weights of the second and the third corner.
struct BoundedWeights {
  Bounded second, third;
};
/// Nothing where the bounds do not tell that the triangle has an area.
std::optional<BoundedWeights> weights_at(
    const std::array<SeenPoint, 3>& triangle, const SeenPoint& at);
std::optional<double> value_of(const BoundedWeights& weights,
                               const std::array<double, 3>& values);

}  // namespace halfspace::detail
