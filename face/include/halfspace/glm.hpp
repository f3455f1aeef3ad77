#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "halfspace/solid.hpp"

/// The library's points and maps as GLM's, for those who use it.
namespace halfspace {

inline Point to_point(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
inline glm::dvec3 to_glm(const Point& p) { return {p.x, p.y, p.z}; }

/// Requires: the matrix's last row is 0, 0, 0, 1.
inline AffineMap to_map(const glm::dmat4& matrix) {
  AffineMap map{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      map[i][j] =
          matrix[static_cast<glm::length_t>(j)][static_cast<glm::length_t>(i)];
    }
  }
  return map;
}

}  // namespace halfspace
