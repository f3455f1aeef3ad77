#include "shade.hpp"

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

Rgb shaded(const Direction& normal) {
  constexpr Direction kLight = {0.15, -0.45, 0.88};
  constexpr Direction kSurface = {236, 214, 184};
  constexpr double kAmbient = 0.22;
  const double length = std::sqrt(
      normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  double facing = 0;  // -1 to 1, the light's direction being of length 1
  if (length > 0) {
    facing = (normal[0] * kLight[0] + normal[1] * kLight[1] +
              normal[2] * kLight[2]) /
             length;
  }
  // Half of the light reaches what lies sideways to it, so that no side of a
  // surface is flat black.
  const double half = 0.5 + 0.5 * facing;
  const double light = kAmbient + (1 - kAmbient) * half * half;
  const auto channel = [light](double full) {
    return static_cast<std::uint8_t>(full * light + 0.5);
  };
  return {channel(kSurface[0]), channel(kSurface[1]), channel(kSurface[2])};
}

}  // namespace halfspace::io
