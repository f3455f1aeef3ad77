#include "halfspace/fast/visible_map.hpp"

#include "halfspace/assert.hpp"
#include "halfspace/cap_parts.hpp"
#include "map/map_maker.hpp"

namespace halfspace::fast {

Result<VisibleMap> visible_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const MapLimits& limits) {
  HALFSPACE_ASSERT(options.keys.empty() ||
                   options.keys.size() == scene.polygon_count());
  return section_map(scene, tree, camera, options, ImageOptions(), limits);
}

Result<VisibleMap> section_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const ImageOptions& image,
                               const MapLimits& limits) {
  HALFSPACE_ASSERT(options.keys.empty() ||
                   options.keys.size() >=
                       scene.polygon_count() + cap_item_count(image));
  return filled_map(
      scene, tree, camera, image, limits,
      [&](MapMaker& maker, const MapLimits& most) {
        maker.light_all(options.cull, most);
      },
      [&](PolygonId item) {
        if (item == kBackground) return kBackgroundKey;
        return options.keys.empty()
                   ? item
                   : options.keys[static_cast<std::size_t>(item)];
      });
}

std::vector<std::vector<std::array<double, 2>>> loops_of(
    const VisibleMap& map, const MapRegion& region) {
  std::vector<std::vector<std::array<double, 2>>> loops;
  for (std::int32_t l = 0; l < region.loop_count; ++l) {
    const auto loop = static_cast<std::size_t>(region.first_loop + l);
    std::vector<std::array<double, 2>>& points = loops.emplace_back();
    for (std::uint32_t k = map.first_corner[loop];
         k < map.first_corner[loop + 1]; ++k) {
      const MapVertex& vertex =
          map.vertices[static_cast<std::size_t>(map.corners[k])];
      points.push_back({vertex.x, vertex.y});
    }
  }
  return loops;
}

}  // namespace halfspace::fast
