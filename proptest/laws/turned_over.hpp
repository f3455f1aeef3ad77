#pragma once

#include <algorithm>
#include <utility>

#include "halfspace/scene.hpp"

namespace halfspace {

/// The scene with one polygon turned over, and without corner colours.
inline Scene turned_over(const Scene& scene, PolygonId polygon) {
  SceneData data = scene.data();
  const auto p = static_cast<std::size_t>(polygon);
  std::reverse(data.corners.begin() + data.first_corner[p],
               data.corners.begin() + data.first_corner[p + 1]);
  data.corner_colors.clear();
  return *make_scene(std::move(data));
}

}  // namespace halfspace
