#include "halfspace/fast/shade/back_faces.hpp"

#include <cstddef>

#include "base/parallel.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/predicate.hpp"
#include "shade/mark.hpp"

namespace halfspace::fast {
namespace {

/// Pixels that a thread marks at once.
constexpr std::size_t kMarkedPixels = 1 << 14;

}  // namespace

void mark_back_faces(const Scene& scene, const Camera& camera,
                     const ItemImage& items, const Rgb& mark, int threads,
                     ColorImage& colors) {
  HALFSPACE_ASSERT(items.pixels.size() == colors.pixels.size());
  const auto polygons = static_cast<PolygonId>(scene.polygon_count());
  for_blocks(threads, items.pixels.size(), kMarkedPixels,
             [&](std::size_t, std::size_t first, std::size_t end) {
               FilterStats stats;
               PolygonId last = kBackground;
               bool is_behind = false;
               for (std::size_t k = first; k < end; ++k) {
                 const PolygonId seen = items.pixels[k];
                 if (seen != last) {
                   last = seen;
                   // Caps have ids beyond those of the polygons.
                   is_behind = seen != kBackground && seen < polygons &&
                               side_of_eye(scene, seen, camera, stats) ==
                                   Side::kNegative;
                 }
                 if (!is_behind) continue;
                 colors.pixels[k] = marked(mark, colors.pixels[k]);
               }
             });
}

}  // namespace halfspace::fast
