#pragma once

#include <array>
#include <cstddef>

#include "halfspace/csg/interval.hpp"

namespace halfspace::csg {

using DoublePoint = std::array<double, 3>;

/// The weights of three points at a point of their plane, seen along an axis:
/// exactly, over a common denominator, which is above 0 if they are on no line.
struct Weights {
  std::array<Integer, 3> weight;
  Integer below;
};

Weights weights_of(const std::array<DoublePoint, 3>& p, const DoublePoint& at,
                   std::size_t axis);

/// The weighted mean, rounded once; io::kNoValue where one of them is.
double mean_of(const Weights& weights, const std::array<double, 3>& values);

}  // namespace halfspace::csg
