#include "map/section_map.hpp"

#include "halfspace/assert.hpp"
#include "map/map_maker.hpp"

namespace halfspace::fast {

Result<VisibleMap> section_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const ImageOptions& image,
                               const MapLimits& limits) {
  HALFSPACE_ASSERT(options.keys.empty() ||
                   options.keys.size() >= scene.polygon_count());
  MapMaker maker(scene, tree, camera, image);
  CellTree& cells = maker.cells();
  // What is kept is behind the planes that the eye is behind (S10, "Caps need
  // no depth order").
  maker.light_caps(-1, limits);
  maker.run(options.cull, true, limits,
            [&](std::span<const HalfPlane> sides, PolygonId source) {
              cells.light(sides, source);
              return !cells.full();
            });
  if (!options.cull) maker.light_caps(1, limits);
  return maker.finish(limits, [&](PolygonId item) {
    if (item == kBackground) return kBackgroundKey;
    return options.keys.empty() ? item
                                : options.keys[static_cast<std::size_t>(item)];
  });
}

}  // namespace halfspace::fast
