#include "generate/clip_planes.hpp"

#include "halfspace/splitmix.hpp"

namespace halfspace::generate {

std::vector<ClipPlane> clip_planes(const Scene& scene, std::uint64_t number,
                                   std::uint64_t count) {
  const auto& vertices = scene.data().vertices;
  std::vector<ClipPlane> planes;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::uint64_t own = mix(number + k);
    const auto entry = [&](unsigned a) {
      return Int128{static_cast<std::int64_t>(own >> 8 * a & 7) - 3};
    };
    ClipPlane plane{entry(0), entry(1), entry(2), 0};
    if (plane.a == 0 && plane.b == 0 && plane.c == 0) plane.a = 1;
    const GridPoint& p = vertices[own % vertices.size()];
    const auto beside = static_cast<std::int64_t>(own >> 32 & 1);
    plane.d = beside - plane.a * p.x - plane.b * p.y - plane.c * p.z;
    planes.push_back(plane);
  }
  const auto made = make_clips(planes, scene.grid_bits());
  return made ? *made : std::vector<ClipPlane>();
}

}  // namespace halfspace::generate
