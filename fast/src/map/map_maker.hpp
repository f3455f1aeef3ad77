#pragma once

#include <functional>

#include "halfspace/fast/visible_map.hpp"
#include "map/cell_tree.hpp"
#include "map/map_feed.hpp"

namespace halfspace::fast {

/// Makes a map: what a tree's fragments do to the cells of the image, from
/// front to back, then regions of cells with one key.
class MapMaker {
 public:
  /// As MapFeed.
  MapMaker(const Scene& scene, const BspTree& tree, const Camera& camera,
           const ImageOptions& image = {});
  /// The map of a small part of the image.
  MapMaker(const Scene& scene, const BspTree& tree, const Camera& camera,
           const ImageOptions& image, const Rectangle& part);

  /// Calls show(sides, source) for the fragments that may be seen, from front
  /// to back, until there are more cells than the limit or show() says false.
  /// What has only lit cells before it is passed by if `unlit_only`.
  template <class Show>
  void run(bool cull, bool unlit_only, const MapLimits& limits,
           const Show& show) {
    if (too_many_) return;
    feed_.run(
        cull,
        [&](const CellBox& box) {
          return !unlit_only || cells_.any_unlit(box);
        },
        [&](std::span<const HalfPlane> sides, PolygonId source) {
          return show(sides, source) && goes_on(limits);
        });
  }
  /// Lights what is seen, caps too.
  void light_all(bool cull, const MapLimits& limits);

  CellTree& cells() { return cells_; }

  /// Errors: kOutOfRange: there are more cells than the limit.
  Result<VisibleMap> finish(
      const MapLimits& limits,
      const std::function<std::int32_t(PolygonId)>& key_of);

 private:
  bool goes_on(const MapLimits& limits) {
    too_many_ = too_many_ || cells_.cell_count() > limits.most_cells;
    return !too_many_;
  }

  MapFeed feed_;
  CellTree cells_;
  bool too_many_ = false;
};

}  // namespace halfspace::fast
