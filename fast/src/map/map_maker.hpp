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
  /// The map of a part of the image, halved so often beforehand.
  MapMaker(const Scene& scene, const BspTree& tree, const Camera& camera,
           const ImageOptions& image, const Rectangle& part, int depth = 0);

  /// Lights what is seen, caps too.
  void light_all(bool cull, const MapLimits& limits);
  /// What becomes of the item of a cell that an item covers, too.
  using Layer = std::function<PolygonId(PolygonId, PolygonId)>;
  /// Covers cells with all that is in the image, caps too, from front to back.
  void cover_all(bool cull, const MapLimits& limits, const Layer& layer);

  CellTree& cells() { return cells_; }
  bool has_too_many() const { return too_many_; }

  /// Requires: !has_too_many().
  VisibleMap finish(const std::function<std::int32_t(PolygonId)>& key_of);

 private:
  /// Calls show(sides, item) for fragments and caps that may be seen, from
  /// front to back, until there are more cells than the limit or show() says
  /// false. What has only lit cells before it is passed by if `unlit_only`.
  template <class Show>
  void run(bool cull, bool unlit_only, const MapLimits& limits,
           const Show& show) {
    const auto show_item = [&](std::span<const HalfPlane> sides,
                               PolygonId item) {
      const bool more = show(sides, item);
      return goes_on(limits) && more;
    };
    // What is kept is behind the planes that the eye is behind (S10, "Caps need
    // no depth order").
    feed_.run_caps(-1, show_item);
    if (too_many_) return;
    feed_.run(
        cull,
        [&](const CellBox& box) {
          return !unlit_only || cells_.any_unlit(box);
        },
        show_item);
    if (!cull && !too_many_) feed_.run_caps(1, show_item);
  }
  bool goes_on(const MapLimits& limits) {
    too_many_ = too_many_ || cells_.cell_count() > limits.most_cells;
    return !too_many_;
  }

  MapFeed feed_;
  CellTree cells_;
  bool too_many_ = false;
};

/// Lights or covers the cells of a maker until there are too many.
using FillCells = std::function<void(MapMaker&, const MapLimits&)>;

/// The map that `fill` makes.
/// Errors: kOutOfRange: there are more cells than the limit; says how many.
Result<VisibleMap> filled_map(
    const Scene& scene, const BspTree& tree, const Camera& camera,
    const ImageOptions& image, const MapLimits& limits, const FillCells& fill,
    const std::function<std::int32_t(PolygonId)>& key_of);

}  // namespace halfspace::fast
