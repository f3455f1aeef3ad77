#pragma once

#include <functional>

#include "halfspace/fast/visible_map.hpp"
#include "map/cell_tree.hpp"
#include "map/fragment_sides.hpp"
#include "map/line_table.hpp"
#include "raster/clip_set.hpp"
#include "tree/eye_classifier.hpp"
#include "tree/traversal.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

/// Makes a map: what a tree's fragments do to the cells of the image, from
/// front to back, then regions of cells with one key.
class MapMaker {
 public:
  /// Of the options clip planes and caps count (S10).
  /// Requires: a tree of this scene without leaves; with caps a closed scene.
  MapMaker(const Scene& scene, const BspTree& tree, const Camera& camera,
           const ImageOptions& image = {});

  /// Calls show(sides, source) for the fragments that may be seen, from front
  /// to back, until there are more cells than the limit or show() says false.
  /// What has only lit cells before it is passed by if `unlit_only`.
  template <class Show>
  void run(bool cull, bool unlit_only, const MapLimits& limits,
           const Show& show) {
    const bool has_boxes = tree_.boxes.size() == tree_.nodes.size();
    const auto enter = [&](NodeId id) {
      CellBox image;
      if (has_boxes && is_gone(id)) return false;
      return !has_boxes ||
             (image_box(id, image) && (!unlit_only || cells_.any_unlit(image)));
    };
    const auto show_node = [&](const Node& node, int sign) {
      const ClipMask mask = clip_mask(node, has_boxes);
      return for_fragments(tree_, node, [&](const TreeFragment& fragment) {
        const int eye_sign = fragment.flipped != 0 ? -sign : sign;
        if (cull && eye_sign < 0) return true;
        std::span<const HalfPlane> sides = sides_.of(fragment, eye_sign);
        if (mask != 0) {
          clipped_.assign(sides.begin(), sides.end());
          if (!add_clips(clips_, mask, fragment.source, eye_sign, lines_,
                         clipped_))
            return true;
          sides = clipped_;
        }
        const bool goes_on = show(sides, fragment.source);
        too_many_ = cells_.cell_count() > limits.most_cells;
        return goes_on && !too_many_;
      });
    };
    if (!too_many_) walk_front_to_back(tree_, eye_side_, enter, show_node);
  }

  CellTree& cells() { return cells_; }

  /// Lights the caps of the clip planes that the eye is on side `side` of: cap
  /// k as item n + k, its hatching as n + 8 + k.
  void light_caps(int side, const MapLimits& limits);

  /// Errors: kOutOfRange: run() made more cells than the limit.
  Result<VisibleMap> finish(
      const MapLimits& limits,
      const std::function<std::int32_t(PolygonId)>& key_of);

 private:
  /// Whether clip planes take away all that a node's box holds.
  bool is_gone(NodeId id) const {
    return !clips_.empty() &&
           clips_.classify(tree_.boxes[static_cast<std::size_t>(id)]).is_gone;
  }
  /// The planes that may cut what a node holds.
  ClipMask clip_mask(const Node& node, bool has_boxes) const {
    if (clips_.empty() || !has_boxes) return clips_.all();
    const auto id = static_cast<std::size_t>(&node - tree_.nodes.data());
    return clips_.classify(tree_.boxes[id]).mask;
  }
  /// A rectangle that holds the image of a node's box; false if none of that
  /// is in the image.
  bool image_box(NodeId id, CellBox& image) const;

  const BspTree& tree_;
  const CameraData& data_;
  const ImageOptions image_;
  TreeReader reader_;
  View view_;
  FilterStats stats_;
  EyeClassifier eye_side_;
  ClipSet clips_;
  LineTable lines_;
  CellTree cells_;
  FragmentSides sides_;
  std::vector<HalfPlane> clipped_;
  bool too_many_ = false;
};

}  // namespace halfspace::fast
