#include "halfspace/fast/visible_map.hpp"

#include "halfspace/assert.hpp"
#include "map/map_maker.hpp"

namespace halfspace::fast {

Result<VisibleMap> visible_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const MapLimits& limits) {
  HALFSPACE_ASSERT(options.keys.empty() ||
                   options.keys.size() == scene.polygon_count());
  MapMaker maker(scene, tree, camera);
  CellTree& cells = maker.cells();
  maker.run(options.cull, true, limits,
            [&](std::span<const HalfPlane> sides, PolygonId source) {
              cells.light(sides, source);
              return !cells.full();
            });
  return maker.finish(limits, [&](PolygonId item) {
    if (item == kBackground) return kBackgroundKey;
    return options.keys.empty() ? item
                                : options.keys[static_cast<std::size_t>(item)];
  });
}

}  // namespace halfspace::fast
