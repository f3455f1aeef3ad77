#include "halfspace/shadow/render.hpp"

#include "halfspace/assert.hpp"

namespace halfspace::shadow {

Report render(const Scene& scene, const fast::BspTree& tree,
              const Camera& camera, const ImageOptions& image,
              const fast::RenderOptions& options, fast::Rendering& result,
              const Options& how) {
  HALFSPACE_ASSERT(options.items);
  fast::render(scene, tree, camera, image, options, result);
  const fast::Rectangle part = options.rectangle.value_or(fast::Rectangle{});
  return check(scene, camera, image,
               {result.items, result.colors, part.left, part.top}, how);
}

}  // namespace halfspace::shadow
