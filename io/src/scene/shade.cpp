#include "scene/shade.hpp"

#include <algorithm>
#include <cmath>

namespace halfspace::io {

Direction normal_of(std::span<const GridPoint> corners) {
  const auto from_first = [&corners](std::size_t i) {
    // Exact: differences of grid points have at most 55 bits, so this rounds
    // once, and only on the largest grid.
    return Direction{static_cast<double>(corners[i].x - corners[0].x),
                     static_cast<double>(corners[i].y - corners[0].y),
                     static_cast<double>(corners[i].z - corners[0].z)};
  };
  Direction sum{};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Direction u = from_first(i);
    const Direction v = from_first(i + 1);
    sum[0] += u[1] * v[2] - u[2] * v[1];
    sum[1] += u[2] * v[0] - u[0] * v[2];
    sum[2] += u[0] * v[1] - u[1] * v[0];
  }
  return sum;
}

Rgb lit(const Rgb& surface, const Direction& normal,
        const ImportOptions& options) {
  const auto dot = [](const Direction& u, const Direction& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  const double length = std::sqrt(dot(normal, normal));
  double sum = 0;
  for (const Light& light : options.lights) {
    double facing = 0;  // -1 to 1
    if (length > 0) facing = dot(normal, light.to_light) / length;
    // Half of the light reaches what lies sideways to it, so that no side of a
    // surface is flat black.
    const double half = 0.5 + 0.5 * facing;
    sum += light.strength * ((1 - options.ambient) * half * half);
  }
  const double share = std::clamp(options.ambient + sum, 0.0, 1.0);
  const auto channel = [share](std::uint8_t full) {
    return static_cast<std::uint8_t>(full * share + 0.5);
  };
  return {channel(surface.r), channel(surface.g), channel(surface.b)};
}

}  // namespace halfspace::io
