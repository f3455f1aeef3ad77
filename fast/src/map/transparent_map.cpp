#include "halfspace/fast/image/transparent_map.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "halfspace/assert.hpp"
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
            const TransparentOptions& options) const {
    Rgb color = options.background;
    for (; list != kBackground; list = at(list).before)
      color = composed_color(scene.color(at(list).polygon), color,
                             options.alpha_of(at(list).polygon));
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
  HALFSPACE_ASSERT(options.alphas.empty() ||
                   options.alphas.size() == scene.polygon_count());
  MapMaker maker(scene, tree, camera);
  Layers layers;
  maker.run(options.cull, false, limits,
            [&](std::span<const HalfPlane> sides, PolygonId source) {
              maker.cells().cover(sides, [&](std::int32_t list) {
                return layers.with(list, source);
              });
              return true;
            });
  Result<VisibleMap> map = maker.finish(limits, [&](std::int32_t list) {
    return list == kBackground ? kBackgroundKey
                               : color_key(layers.color(scene, list, options));
  });
  if (!map) return map;
  for (MapRegion& region : map->regions) region.item = region.key;
  return map;
}

}  // namespace halfspace::fast
