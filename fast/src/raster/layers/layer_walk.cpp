#include "raster/layers/layer_walk.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "raster/band_walk.hpp"

namespace halfspace::fast {

/// Shows a leaf back to front: all of its tiles at once, or where that takes
/// too many masks parts of them, one after the other.
template <int kBits, class EyeSide>
class LeafPainter {
 public:
  LeafPainter(TileView& screen, PolygonRasterizer<kBits>& rasterizer,
              LeafLayers& layers, EyeSide eye_side)
      : screen_(screen),
        rasterizer_(rasterizer),
        layers_(layers),
        eye_side_(std::move(eye_side)) {}

  void show(const Node& leaf) {
    const PixelRange lines = screen_.lines;
    parts_.push_back({{lines.first / kTileHeight,
                       (lines.end + kTileHeight - 1) / kTileHeight},
                      {0, screen_.tiles_across}});
    while (!parts_.empty()) {
      const Part part = parts_.back();
      parts_.pop_back();
      screen_.lines = {std::max(lines.first, part.rows.first * kTileHeight),
                       std::min(lines.end, part.rows.end * kTileHeight)};
      if (!show(leaf, part)) divide(part);
    }
    screen_.lines = lines;
  }

 private:
  /// Rows of tiles, or some tiles of one row.
  struct Part {
    PixelRange rows;
    PixelRange tiles;
  };

  static std::int32_t length(const PixelRange& range) {
    return range.end - range.first;
  }

  /// False, and nothing shown, where that takes too many masks.
  bool show(const Node& leaf, const Part& part) {
    const bool is_least = length(part.rows) == 1 && length(part.tiles) == 1;
    const bool is_narrow = length(part.tiles) < screen_.tiles_across;
    const std::size_t fragments = rasterizer_.fragments();
    const std::int64_t touches = screen_.touches;
    std::uint64_t* const open = screen_.open + screen_.open_at(part.rows.first);
    if (is_narrow) {
      open_.assign(open, open + screen_.words_across);
      for (std::int32_t tile = 0; tile < screen_.tiles_across; ++tile) {
        if (tile >= part.tiles.first && tile < part.tiles.end) continue;
        open[tile / 64] &= ~(std::uint64_t{1} << (tile % 64));
      }
    }
    layers_.begin(is_least ? std::numeric_limits<std::size_t>::max()
                           : LeafLayers::kMostMasks);
    rasterizer_.draw_leaf(leaf, eye_side_);
    if (is_narrow) std::copy(open_.begin(), open_.end(), open);
    if (!layers_.is_full()) {
      layers_.show();
      return true;
    }
    layers_.clear();
    rasterizer_.set_fragments(fragments);
    screen_.touches = touches;
    return false;
  }

  void divide(const Part& part) {
    const bool by_rows = length(part.rows) > 1;
    const PixelRange& range = by_rows ? part.rows : part.tiles;
    const std::int32_t middle = range.first + length(range) / 2;
    for (const PixelRange& half :
         {PixelRange{middle, range.end}, PixelRange{range.first, middle}}) {
      parts_.push_back(by_rows ? Part{half, part.tiles}
                               : Part{part.rows, half});
    }
  }

  TileView& screen_;
  PolygonRasterizer<kBits>& rasterizer_;
  LeafLayers& layers_;
  EyeSide eye_side_;
  std::vector<Part> parts_;
  std::vector<std::uint64_t> open_;  ///< what was open of a row
};

template <int kBits>
void show_back_to_front(const Frame& frame, TileBuffer& buffer,
                        PolygonRasterizer<kBits>& rasterizer,
                        LeafLayers& layers, FilterStats& stats) {
  const BspTree& tree = frame.reader.tree();
  TileView& screen = buffer.view();
  screen.overwrite = true;
  const EyeClassifier eye_side(frame.reader, frame.view, frame.camera, stats);
  const auto side_of_source = [&](const TreeFragment& fragment) {
    return eye_side(frame.reader.planes().plane(fragment.source),
                    fragment.source);
  };
  LeafPainter leaf_painter(screen, rasterizer, layers, side_of_source);
  // Other colours than the scene's are only asked for by layers.
  const bool is_opaque = frame.alpha == kOpaque && frame.colors == nullptr;
  std::vector<std::int32_t> scratch;
  const auto show = [&](const Node& node, int sign) {
    if (node.first_fragment == kNoFragment) return true;
    rasterizer.set_clips(clip_mask(frame, node));
    const bool is_leaf = node.splitter == kNoPlane;
    rasterizer.show_in(is_opaque && !is_leaf ? nullptr : &layers);
    if (!is_leaf) {
      return for_fragments_reversed(
          tree, node, scratch, [&](const TreeFragment& fragment) {
            rasterizer.draw(fragment, source_side(fragment, sign));
            return true;
          });
    }
    const TreeFragment& first = fragment_at(tree, node.first_fragment);
    if (first.next == kNoFragment) {
      rasterizer.draw_any(first, side_of_source);
    } else {
      leaf_painter.show(node);
    }
    return true;
  };
  const BehindTest behind(frame.reader, frame.view, frame.camera);
  walk_back_to_front(tree, eye_side, Gate(frame, screen), show,
                     [&](const Node& node, int sign, int side) {
                       return !behind(node.plane, node.splitter, sign, side);
                     });
}

template void show_back_to_front<26>(const Frame&, TileBuffer&,
                                     PolygonRasterizer<26>&, LeafLayers&,
                                     FilterStats&);
template void show_back_to_front<40>(const Frame&, TileBuffer&,
                                     PolygonRasterizer<40>&, LeafLayers&,
                                     FilterStats&);
template void show_back_to_front<54>(const Frame&, TileBuffer&,
                                     PolygonRasterizer<54>&, LeafLayers&,
                                     FilterStats&);

}  // namespace halfspace::fast
