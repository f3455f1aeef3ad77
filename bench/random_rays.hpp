#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "halfspace/ray.hpp"
#include "halfspace/scene.hpp"
#include "random.hpp"

/// Rays in all directions through a scene.
namespace halfspace::bench {

/// A box about all vertices. Units: grid steps.
struct Extent {
  std::array<double, 3> middle{};
  double radius = 0;
};

inline Extent extent_of(const Scene& scene) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const GridPoint& p : scene.data().vertices) {
    const std::array<std::int64_t, 3> at = {p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], static_cast<double>(at[k]));
      high[k] = std::max(high[k], static_cast<double>(at[k]));
    }
  }
  Extent extent;
  for (std::size_t k = 0; k < 3; ++k) {
    extent.middle[k] = (low[k] + high[k]) / 2;
    extent.radius = std::max(extent.radius, (high[k] - low[k]) / 2);
  }
  return extent;
}

/// Rays from points about the scene towards points in it, on the lattice.
inline std::vector<Ray> random_rays(const Scene& scene, const Extent& extent,
                                    std::size_t count, std::uint64_t seed) {
  Random random(seed);
  // From 0 to 1.
  const auto share = [&random] {
    return static_cast<double>(random.between(0, 1 << 30)) * 0x1p-30;
  };
  std::vector<Ray> rays;
  while (rays.size() < count) {
    std::array<double, 3> from, to;
    for (std::size_t k = 0; k < 3; ++k) {
      from[k] = extent.middle[k] + extent.radius * (4 * share() - 2);
      to[k] = extent.middle[k] + extent.radius * (2 * share() - 1);
    }
    const auto lattice = [](double steps) {
      return static_cast<Int128>(std::nearbyint(256 * steps));
    };
    RayData data;
    data.origin = {lattice(from[0]), lattice(from[1]), lattice(from[2])};
    data.direction = {lattice(to[0]) - data.origin.x,
                      lattice(to[1]) - data.origin.y,
                      lattice(to[2]) - data.origin.z};
    const Result<Ray> ray = make_ray(data, scene.grid_bits());
    if (ray) rays.push_back(*ray);
  }
  return rays;
}

}  // namespace halfspace::bench
