#pragma once

#include <optional>
#include <span>
#include <vector>

#include "halfspace/fast/render.hpp"
#include "map/cap_pieces.hpp"
#include "map/cell_tree.hpp"
#include "map/fragment_sides.hpp"
#include "map/line_table.hpp"
#include "raster/clip_set.hpp"
#include "tree/eye_classifier.hpp"
#include "tree/leaf_divider.hpp"
#include "tree/traversal.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

/// What a map is made of: a tree's fragments from front to back, and caps, each
/// as half-planes of the image.
class MapFeed {
 public:
  /// Of the options clip planes and caps count (S10); of the image `part`.
  /// Requires: a tree of this scene; with caps a closed scene.
  MapFeed(const Scene& scene, const BspTree& tree, const Camera& camera,
          const ImageOptions& image, const Rectangle& part);

  /// Calls show(sides, source) for the fragments that may be seen, from front
  /// to back, until it says false; passes by subtrees whose image lies in a box
  /// that is_open(box) says no to.
  template <class IsOpen, class Show>
  void run(bool cull, const IsOpen& is_open, const Show& show) {
    const bool has_boxes = tree_.boxes.size() == tree_.nodes.size();
    const auto enter = [&](NodeId id) {
      CellBox image;
      if (has_boxes && is_gone(id)) return false;
      return !has_boxes || (image_box(id, image) && is_open(image));
    };
    const auto show_node = [&](const Node& node, int sign) {
      const ClipMask mask = clip_mask(node, has_boxes);
      if (node.splitter == kNoPlane) return show_leaf(node, mask, cull, show);
      return show_list(tree_, node, sides_, sign, mask, cull, show);
    };
    walk_front_to_back(tree_, eye_side_, enter, show_node);
  }

  /// Calls show(sides, item) for the pieces of the caps of the clip planes that
  /// the eye is on side `side` of, until it says false: cap k is item n + k,
  /// its hatching n + 8 + k.
  template <class Show>
  void run_caps(int side, const Show& show) {
    if (!image_.caps) return;
    const auto count = static_cast<PolygonId>(scene().polygon_count());
    for (std::size_t k = 0; k < image_.clips.size(); ++k) {
      if (lines_.side_of_eye(plane_id_of_clip(k)) != side) continue;
      for (const CapPiece& piece :
           cap_pieces(reader_, view_, data_, image_, k, side, lines_)) {
        if (!show(piece.sides, count + number_of(piece.cap))) return;
      }
    }
  }

  const TreeReader& reader() const { return reader_; }
  const View& view() const { return view_; }
  const EyeClassifier& eye_side() const { return eye_side_; }
  LineTable& lines() { return lines_; }
  const FilterStats& stats() const { return stats_; }

 private:
  /// Leaves, one after another, as trees of their fragments.
  struct Leaves {
    explicit Leaves(MapFeed& feed)
        : divider(feed.scene(), feed.tree_, feed.stats_),
          reader(feed.scene(), divider.part()),
          sides(reader, feed.data_, feed.lines_) {}

    LeafDivider divider;
    TreeReader reader;
    FragmentSides sides;
  };

  const Scene& scene() const { return reader_.scene(); }

  template <class Show>
  bool show_leaf(const Node& leaf, ClipMask mask, bool cull, const Show& show) {
    if (!leaves_) leaves_.emplace(*this);
    bool goes_on = true;
    const auto show_node = [&](const Node& node, int sign) {
      goes_on = show_list(leaves_->divider.part(), node, leaves_->sides, sign,
                          mask, cull, show);
      return goes_on;
    };
    walk_front_to_back(leaves_->divider.divide(leaf), eye_side_, EnterAll(),
                       show_node);
    return goes_on;
  }
  /// Shows a node's list of fragments.
  template <class Show>
  bool show_list(const BspTree& tree, const Node& node, FragmentSides& sides_of,
                 int sign, ClipMask mask, bool cull, const Show& show) {
    return for_fragments(tree, node, [&](const TreeFragment& fragment) {
      const int eye_sign = fragment.flipped != 0 ? -sign : sign;
      if (cull && eye_sign < 0) return true;
      std::span<const HalfPlane> sides = sides_of.of(fragment, eye_sign);
      if (mask != 0) {
        clipped_.assign(sides.begin(), sides.end());
        if (!add_clips(clips_, mask, fragment.source, eye_sign, lines_,
                       clipped_))
          return true;
        sides = clipped_;
      }
      return show(sides, fragment.source);
    });
  }

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
  /// is in the part.
  bool image_box(NodeId id, CellBox& image) const;

  const BspTree& tree_;
  const CameraData& data_;
  const ImageOptions image_;
  CellBox part_;  ///< in twice the image's coordinates
  TreeReader reader_;
  View view_;
  FilterStats stats_;
  EyeClassifier eye_side_;
  ClipSet clips_;
  LineTable lines_;
  FragmentSides sides_;
  std::optional<Leaves> leaves_;  ///< if there are any
  std::vector<HalfPlane> clipped_;
};

}  // namespace halfspace::fast
