#pragma once

#include <optional>

#include "raster/band_walk.hpp"
#include "raster/layers/layer_walk.hpp"
#include "sah/lazy_cells.hpp"

namespace halfspace::fast {

/// Displays a lazy tree in one band: comes to its cells in order, and has those
/// built of which something may be seen. One rasterizer goes from tree to tree.
template <int kBits>
class LazyWalk {
 public:
  /// Requires: `frame` reads the planes of the tree's root.
  LazyWalk(const Frame& frame, const LazyTree::State& tree, TileBuffer& buffer)
      : tree_(tree),
        buffer_(buffer),
        reader_(frame.reader),
        frame_{*reader_,     frame.camera, frame.image, frame.view,
               frame.kernel, frame.clips,  frame.alpha, frame.colors},
        rasterizer_(frame_, buffer.view()) {}

  PolygonRasterizer<kBits>& rasterizer() { return rasterizer_; }
  const Frame& frame() const { return frame_; }  ///< of the rasterizer

  void show_front_to_back(FilterStats& stats) {
    show<true>(tree_.root, stats, [&] {
      fast::show_front_to_back(frame_, buffer_, rasterizer_, stats, NoCells());
    });
  }
  void show_back_to_front(LeafLayers& layers, FilterStats& stats) {
    buffer_.view().overwrite = true;
    show<false>(tree_.root, stats, [&] {
      fast::show_back_to_front(frame_, buffer_, rasterizer_, layers, stats);
    });
  }

 private:
  /// Comes to the cells of a part; recurses into those that were divided again,
  /// of which there are at most some in each other.
  template <bool kNearFirst, class ShowTree>
  void show(const LazyPart& part, FilterStats& stats, ShowTree&& show_tree) {
    if (!part.has_cells()) {
      // The rasterizer's frame refers to this one. What it knows of polygons
      // holds: it is of the view, or of a fragment by its address, of which
      // none is reused while trees stay; and it compares the fragments of one
      // leaf alone, each of which it has begun there.
      reader_.emplace(*tree_.scene, part.tree);
      show_tree();
      return;
    }
    const TreeReader reader(*tree_.scene, part.tree);
    const Frame frame = {reader,       frame_.camera, frame_.image,
                         frame_.view,  frame_.kernel, frame_.clips,
                         frame_.alpha, frame_.colors};
    const TileView& screen = buffer_.view();
    const EyeClassifier eye_side(reader, frame.view, frame.camera, stats);
    walk<kNearFirst>(
        part.tree, eye_side, ReachAll(), Gate(frame, screen),
        [&](const Node& node, int) {
          if (node.splitter == kNoPlane) {
            const auto leaf =
                static_cast<NodeId>(&node - part.tree.nodes.data());
            show<kNearFirst>(tree_.part_at(part, leaf), stats, show_tree);
          }
          return screen.open_tiles > 0;
        });
  }

  const LazyTree::State& tree_;
  TileBuffer& buffer_;
  std::optional<TreeReader> reader_;
  Frame frame_;
  PolygonRasterizer<kBits> rasterizer_;
};

}  // namespace halfspace::fast
