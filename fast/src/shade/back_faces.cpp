#include "halfspace/fast/shade/back_faces.hpp"

#include <algorithm>
#include <cstddef>

#include "base/parallel.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/predicate.hpp"

namespace halfspace::fast {
namespace {

/// Pixels that a thread marks at once.
constexpr std::size_t kMarkedPixels = 1 << 14;

/// The mark where a polygon has a colour with that greatest channel.
Rgb dimmed_mark(const Rgb& mark, int light) {
  const auto channel = [light](int full) {
    return static_cast<std::uint8_t>((full * (255 + light) + 255) / 510);
  };
  return {channel(mark.r), channel(mark.g), channel(mark.b)};
}

}  // namespace

void mark_back_faces(const Scene& scene, const Camera& camera,
                     const ItemImage& items, const Rgb& mark, int threads,
                     ColorImage& colors) {
  HALFSPACE_ASSERT(items.pixels.size() == colors.pixels.size());
  const auto polygons = static_cast<PolygonId>(scene.polygon_count());
  for_blocks(
      threads, items.pixels.size(), kMarkedPixels,
      [&](std::size_t, std::size_t first, std::size_t end) {
        FilterStats stats;
        PolygonId last = kBackground;
        bool is_behind = false;
        for (std::size_t k = first; k < end; ++k) {
          const PolygonId seen = items.pixels[k];
          if (seen != last) {
            last = seen;
            // Caps have ids beyond those of the polygons.
            is_behind =
                seen != kBackground && seen < polygons &&
                side_of_eye(scene, seen, camera, stats) == Side::kNegative;
          }
          if (!is_behind) continue;
          Rgb& color = colors.pixels[k];
          color = dimmed_mark(mark, std::max({color.r, color.g, color.b}));
        }
      });
}

}  // namespace halfspace::fast
