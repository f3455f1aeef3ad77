#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/ref/visible_map.hpp"

namespace halfspace::ref {

/// How much of a key is seen (S7.7).
struct SeenArea {
  std::int32_t key = kBackgroundKey;
  Rational area_px;        ///< square pixels
  double solid_angle = 0;  ///< steradians; 0 in a parallel view
};

/// The seen areas of all keys of the map of `camera`, the background first,
/// then by key.
/// Exact: the areas; solid angles are computed with 50 digits.
std::vector<SeenArea> seen_areas(const std::vector<MapArc>& map,
                                 const Camera& camera);

}  // namespace halfspace::ref
