#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "halfspace/polygon.hpp"

/// Polygons for the tests of triangulation and of shapes.
namespace halfspace::io::samples {

using Polygon = std::vector<GridPoint>;

/// A number from 0 to `count` - 1.
inline std::int64_t draw(std::mt19937& random, std::int64_t count) {
  return static_cast<std::int64_t>(random()) % count;
}

/// A circle with waves.
inline Polygon waves(int count) {
  Polygon polygon;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / count;
    const double radius = 1e9 * (1 + 0.1 * std::sin(40 * angle));
    polygon.push_back({std::llround(radius * std::cos(angle)),
                       std::llround(radius * std::sin(angle)), 0});
  }
  return polygon;
}

}  // namespace halfspace::io::samples
