#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/fast/visible_map.hpp"

namespace halfspace::fast {

/// How much of a key is seen (S7.7).
struct SeenArea {
  std::int32_t key = kBackgroundKey;
  double area_px = 0;      ///< square pixels
  double solid_angle = 0;  ///< steradians; 0 in a parallel view
};

/// The seen areas of all keys of the map of `camera`, the background first,
/// then by key.
///
/// Exact: the doubles nearest to the exact areas; solid angles are off by less
///        than 1e-45 before they are rounded.
/// Cost:  some 100 us an arc.
std::vector<SeenArea> seen_areas(const VisibleMap& map, const Camera& camera);

/// The seen area of a key as a quotient of integers in lowest terms, such as
/// `3/2`. Units: square pixels.
/// Cost: the square of the number of the key's arcs, whose sums' numbers grow.
std::string exact_seen_area(const VisibleMap& map, std::int32_t key);

/// By how much a square pixel of a parallel view stands for the area across the
/// direction of view (S7.7). Units: squares of lattice steps.
double pixel_area(const Camera& camera);

}  // namespace halfspace::fast
