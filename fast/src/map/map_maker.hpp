#pragma once

#include <functional>

#include "halfspace/fast/visible_map.hpp"
#include "map/cell_tree.hpp"
#include "map/fragment_sides.hpp"
#include "map/line_table.hpp"
#include "tree/eye_classifier.hpp"
#include "tree/traversal.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

/// Makes a map: what a tree's fragments do to the cells of the image, from
/// front to back, then regions of cells with one key.
class MapMaker {
 public:
  /// Requires: a tree of this scene without leaves.
  MapMaker(const Scene& scene, const BspTree& tree, const Camera& camera);

  /// Calls show(sides, source) for the fragments that may be seen, from front
  /// to back, until there are more cells than the limit or show() says false.
  /// What has only lit cells before it is passed by if `unlit_only`.
  template <class Show>
  void run(bool cull, bool unlit_only, const MapLimits& limits,
           const Show& show) {
    const bool has_boxes = tree_.boxes.size() == tree_.nodes.size();
    const auto enter = [&](NodeId id) {
      CellBox image;
      return !has_boxes ||
             (image_box(id, image) && (!unlit_only || cells_.any_unlit(image)));
    };
    const auto show_node = [&](const Node& node, int sign) {
      return for_fragments(tree_, node, [&](const TreeFragment& fragment) {
        const int eye_sign = fragment.flipped != 0 ? -sign : sign;
        if (cull && eye_sign < 0) return true;
        const bool goes_on =
            show(sides_.of(fragment, eye_sign), fragment.source);
        too_many_ = cells_.cell_count() > limits.most_cells;
        return goes_on && !too_many_;
      });
    };
    walk_front_to_back(tree_, eye_side_, enter, show_node);
  }

  CellTree& cells() { return cells_; }

  /// Errors: kOutOfRange: run() made more cells than the limit.
  Result<VisibleMap> finish(
      const MapLimits& limits,
      const std::function<std::int32_t(PolygonId)>& key_of);

 private:
  /// A rectangle that holds the image of a node's box; false if none of that
  /// is in the image.
  bool image_box(NodeId id, CellBox& image) const;

  const BspTree& tree_;
  const CameraData& data_;
  TreeReader reader_;
  View view_;
  FilterStats stats_;
  EyeClassifier eye_side_;
  LineTable lines_;
  CellTree cells_;
  FragmentSides sides_;
  bool too_many_ = false;
};

}  // namespace halfspace::fast
