#include "halfspace/fast/visible_map.hpp"

#include "halfspace/assert.hpp"
#include "map/section_map.hpp"

namespace halfspace::fast {

Result<VisibleMap> visible_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const MapLimits& limits) {
  HALFSPACE_ASSERT(options.keys.empty() ||
                   options.keys.size() == scene.polygon_count());
  return section_map(scene, tree, camera, options, ImageOptions(), limits);
}

}  // namespace halfspace::fast
