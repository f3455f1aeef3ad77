#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace halfspace::io {

/// The greatest of the components' sizes.
inline double greatest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The vector with length 1, or itself if it is zero. Scaled by a power of two
/// first, so that no length is too large or too small for a double.
inline glm::dvec3 unit_vector(const glm::dvec3& v) {
  const double size = greatest(v);
  if (size == 0) return v;
  const int exponent = std::ilogb(size);
  return glm::normalize(glm::dvec3(std::ldexp(v.x, -exponent),
                                   std::ldexp(v.y, -exponent),
                                   std::ldexp(v.z, -exponent)));
}

}  // namespace halfspace::io
