#include <vector>

#include "base/hash_index.hpp"
#include "exact/canonical_plane.hpp"
#include "halfspace/assert.hpp"
#include "tree/scene_planes.hpp"

namespace halfspace::fast {
namespace {

template <int kBits>
PlaneTable plane_table(const Scene& scene) {
  PlaneTable table;
  table.plane_of.reserve(scene.polygon_count());
  std::vector<ExactPlane<kBits>> planes;
  std::vector<bool> flipped;
  HashIndex index;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto polygon = static_cast<PolygonId>(p);
    const CanonicalPlane<kBits> plane =
        canonical_plane(exact_plane<kBits>(plane_corners(scene, polygon)));
    std::int32_t id = index.find(plane.hash, [&](std::int32_t other) {
      return is_same_plane(planes[static_cast<std::size_t>(other)],
                           plane.exact);
    });
    if (id < 0) {
      id = static_cast<std::int32_t>(planes.size());
      index.enter(plane.hash, id);
      planes.push_back(plane.exact);
      flipped.push_back(plane.flipped);
      table.first_polygon.push_back(polygon);
    }
    table.plane_of.push_back(id);
    table.same_orientation.push_back(flipped[static_cast<std::size_t>(id)] ==
                                     plane.flipped);
  }
  HALFSPACE_ASSERT(table.plane_of.size() == scene.polygon_count());
  HALFSPACE_ASSERT(planes.size() <= scene.polygon_count());
  return table;
}

}  // namespace

PlaneTable intern_planes(const Scene& scene) {
  return with_grid(scene.grid_bits(),
                   [&](auto bits) { return plane_table<bits()>(scene); });
}

}  // namespace halfspace::fast
