#pragma once

#include <cstdint>
#include <map>

#include "exact/big_rational.hpp"
#include "halfspace/fast/visible_map.hpp"

namespace halfspace::fast {

/// The area of a key in a pixel, and its first moments from the pixel's left
/// top corner. Units: pixels.
struct ExactMoments {
  BigRational area = 0;
  BigRational x = 0;
  BigRational y = 0;
};

/// A point of the image. Units: pixels.
struct ExactPoint {
  BigRational x, y;
};

/// A vertex of the map, from the lines that meet there.
ExactPoint point_of(const VisibleMap& map, std::int32_t vertex);

/// The moments of all keys that arcs in or at a pixel bound (S7.6), in
/// rationals.
///
/// Cost: a look at every arc of the map.
std::map<std::int32_t, ExactMoments> exact_moments(const VisibleMap& map,
                                                   std::int32_t column,
                                                   std::int32_t row);

}  // namespace halfspace::fast
