#pragma once

#include "halfspace/fast/predicate.hpp"
#include "raster/culler.hpp"
#include "raster/frame.hpp"
#include "raster/polygon_rasterizer.hpp"
#include "raster/tile_buffer.hpp"
#include "tree/behind_test.hpp"
#include "tree/traversal.hpp"

namespace halfspace::fast {

/// The eye's side of a fragment's source, from that of its node.
inline int source_side(const TreeFragment& fragment, int node_sign) {
  return fragment.flipped != 0 ? -node_sign : node_sign;
}

/// The clip planes that may cut what is in a node.
inline ClipMask clip_mask(const Frame& frame, const Node& node) {
  if (frame.clips.empty()) return 0;
  const BspTree& tree = frame.reader.tree();
  if (tree.boxes.size() != tree.nodes.size()) return frame.clips.all();
  const auto n = static_cast<std::size_t>(&node - tree.nodes.data());
  const ClipState state = frame.clips.classify(tree.boxes[n]);
  return state.is_gone ? frame.clips.all() : state.mask;
}

/// Which subtrees something may be seen of.
class Gate {
 public:
  Gate(const Frame& frame, const TileView& screen)
      : frame_(frame),
        culler_(frame.view, frame.kernel, screen),
        has_boxes_(frame.reader.tree().boxes.size() ==
                   frame.reader.tree().nodes.size()) {}

  bool has_boxes() const { return has_boxes_; }

  bool operator()(NodeId id) const {
    if (!has_boxes_) return true;
    const BspTree& tree = frame_.reader.tree();
    const auto n = static_cast<std::size_t>(id);
    const Node& node = tree.nodes[n];
    const Box& box = tree.boxes[n];
    if (!frame_.clips.empty() && frame_.clips.classify(box).is_gone) {
      return false;
    }
    // Drawing one fragment is faster than testing its box.
    const bool is_single = node.splitter != kNoPlane &&
                           node.positive == kNoNode && node.negative == kNoNode;
    return is_single || culler_.can_show(box);
  }

 private:
  const Frame& frame_;
  Culler culler_;
  bool has_boxes_;
};

/// What shows the cells of a tree that has none.
struct NoCells {
  void operator()(NodeId) const {}
};

/// Shows the frame's tree front to back on what is unlit of the band.
///
/// A leaf without fragments is a cell that is kept free: show_cell(id) shows
/// what is in it now, with rasterizers of its own; `screen.exact` must be
/// afterwards as it was.
template <int kBits, class ShowCell>
void show_front_to_back(const Frame& frame, TileBuffer& buffer,
                        PolygonRasterizer<kBits>& rasterizer,
                        FilterStats& stats, ShowCell&& show_cell) {
  const BspTree& tree = frame.reader.tree();
  TileView& screen = buffer.view();
  const EyeClassifier eye_side(frame.reader, frame.view, frame.camera, stats,
                               frame.moved);
  const Gate enter(frame, screen);
  const auto side_of_source = [&](const TreeFragment& fragment) {
    return eye_side(frame.reader.planes().plane(fragment.source),
                    fragment.source);
  };
  // A leaf is drawn when the next one is found: its vertices are fetched from
  // memory meanwhile.
  const Node* waiting = nullptr;
  ClipMask waiting_clips = 0;
  const auto draw_waiting = [&] {
    if (waiting == nullptr) return;
    // One fragment hides nothing of its own.
    const auto first = static_cast<std::size_t>(waiting->first_fragment);
    if (tree.fragments[first].next != kNoFragment) buffer.enter_leaf();
    rasterizer.set_clips(waiting_clips);
    rasterizer.draw_leaf(*waiting, side_of_source);
    waiting = nullptr;
  };
  const auto show = [&](const Node& node, int sign) {
    if (node.splitter == kNoPlane) {
      if (node.first_fragment == kNoFragment) {
        draw_waiting();
        show_cell(static_cast<NodeId>(&node - tree.nodes.data()));
        return screen.open_tiles > 0;
      }
      rasterizer.prefetch(node);
      draw_waiting();
      waiting = &node;
      waiting_clips = clip_mask(frame, node);
    } else if (node.first_fragment != kNoFragment) {
      draw_waiting();
      rasterizer.set_clips(clip_mask(frame, node));
      for_fragments(tree, node, [&](const TreeFragment& fragment) {
        rasterizer.draw(fragment, source_side(fragment, sign));
        return true;
      });
    }
    return screen.open_tiles > 0;
  };
  // Boxes leave out what is behind, and more.
  const BehindTest behind(frame.reader, frame.view, frame.camera);
  const bool has_test = !enter.has_boxes() && frame.moved == nullptr;
  walk_front_to_back(
      tree, eye_side, enter, show, [&](const Node& node, int sign, int side) {
        return !has_test || !behind(node.plane, node.splitter, sign, side);
      });
  draw_waiting();
}

}  // namespace halfspace::fast
