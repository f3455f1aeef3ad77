#include "halfspace/fast/image/transparent_map.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "halfspace/assert.hpp"
#include "halfspace/cap_parts.hpp"
#include "map/map_maker.hpp"

namespace halfspace::fast {
namespace {

/// The polygons that cover a cell, the farthest first: a number for each list
/// that there is, kBackground for the empty one.
class Layers {
 public:
  /// The list with one polygon more, behind all of it.
  std::int32_t with(std::int32_t list, PolygonId farthest) {
    const std::uint64_t name = std::uint64_t{static_cast<std::uint32_t>(list)}
                                   << 32 |
                               static_cast<std::uint32_t>(farthest);
    const auto next = static_cast<std::int32_t>(layers_.size());
    const auto [found, is_new] = numbers_.try_emplace(name, next);
    if (is_new) layers_.push_back({farthest, list});
    return found->second;
  }

  /// The colour of a list (S5.6): its farthest polygon is blended first.
  Rgb color(const Scene& scene, std::int32_t list,
            const TransparentOptions& options,
            const ImageOptions& section) const {
    const auto count = static_cast<PolygonId>(scene.polygon_count());
    Rgb color = options.background;
    for (; list != kBackground; list = at(list).before) {
      const PolygonId item = at(list).polygon;
      if (item < count) {
        color =
            composed_color(scene.color(item), color, options.alpha_of(item));
      } else {
        const CapItem cap = cap_item(static_cast<std::size_t>(item - count));
        color = composed_color(color_of(section, cap), color,
                               options.alpha_of_cap(cap.part));
      }
    }
    return color;
  }

 private:
  struct Layer {
    PolygonId polygon = 0;
    std::int32_t before = kBackground;  ///< the list of what is in front
  };
  const Layer& at(std::int32_t list) const {
    return layers_[static_cast<std::size_t>(list)];
  }

  std::vector<Layer> layers_;
  std::unordered_map<std::uint64_t, std::int32_t> numbers_;
};

}  // namespace

Result<VisibleMap> transparent_map(const Scene& scene, const BspTree& tree,
                                   const Camera& camera,
                                   const TransparentOptions& options,
                                   const MapLimits& limits) {
  return transparent_section(scene, tree, camera, options, {}, limits);
}

Result<VisibleMap> transparent_section(const Scene& scene, const BspTree& tree,
                                       const Camera& camera,
                                       const TransparentOptions& options,
                                       const ImageOptions& image,
                                       const MapLimits& limits) {
  HALFSPACE_ASSERT(options.alphas.empty() ||
                   options.alphas.size() == scene.polygon_count());
  Layers layers;
  Result<VisibleMap> map = filled_map(
      scene, tree, camera, image, limits,
      [&](MapMaker& maker, const MapLimits& most) {
        layers = {};
        maker.cover_all(options.cull, most,
                        [&](std::int32_t list, PolygonId item) {
                          return layers.with(list, item);
                        });
      },
      [&](std::int32_t list) {
        return list == kBackground
                   ? kBackgroundKey
                   : color_key(layers.color(scene, list, options, image));
      });
  if (!map) return map;
  for (MapRegion& region : map->regions) region.item = region.key;
  return map;
}

}  // namespace halfspace::fast
