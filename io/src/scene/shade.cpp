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
        const Direction& to_light) {
  constexpr double kAmbient = 0.22;
  const auto dot = [](const Direction& u, const Direction& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  const double length = std::sqrt(dot(normal, normal));
  double facing = 0;  // -1 to 1
  if (length > 0) facing = dot(normal, to_light) / length;
  // Half of the light reaches what lies sideways to it, so that no side of a
  // surface is flat black.
  const double half = 0.5 + 0.5 * facing;
  const double light = std::min(1.0, kAmbient + (1 - kAmbient) * half * half);
  const auto channel = [light](std::uint8_t full) {
    return static_cast<std::uint8_t>(full * light + 0.5);
  };
  return {channel(surface.r), channel(surface.g), channel(surface.b)};
}

}  // namespace halfspace::io
