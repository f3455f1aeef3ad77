#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "camera/view.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/image.hpp"
#include "raster/exact_coverage.hpp"
#include "raster/frame.hpp"
#include "raster/gouraud.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "raster/layers/leaf_layers.hpp"
#include "raster/leaf_depth.hpp"
#include "tree/traversal.hpp"

namespace halfspace::fast {

/// Draws the fragments of a tree on one screen, and decides what the kernel
/// cannot.
template <int kBits>
class PolygonRasterizer final : public ExactFallback, public LayerOrder {
 public:
  PolygonRasterizer(const Frame& frame, TileView& screen);

  /// Back to front polygons go there, and not at once into the images.
  void show_in(LeafLayers* layers) {
    layers_ = layers;
    blends = layers != nullptr;
  }

  /// The clip planes that may cut what is drawn from now on.
  void set_clips(ClipMask mask) { clip_mask_ = mask; }

  /// To be called where the frame's view has become another one.
  void forget() {
    depth_.forget();
    late_ = kBackground;
  }

  /// Draws a fragment whose source has the eye on side `eye_sign`.
  void draw(const TreeFragment& fragment, int eye_sign);

  /// Draws one for which that is not known: eye_side(fragment) decides it where
  /// its outline does not.
  template <class EyeSide>
  void draw_any(const TreeFragment& fragment, EyeSide&& eye_side) {
    const Projection projection = project(fragment);
    if (projection == Projection::kUnseen) return;
    int sign = projection == Projection::kOutline ? turn(corner_count_) : 0;
    sign = sign != 0 ? -frame_.view.orientation * sign : eye_side(fragment);
    if (sign == 0 || (frame_.image.cull && sign < 0)) return;
    draw_projected(fragment, projection, sign);
  }

  /// Draws the fragments of a leaf, whose order does not matter.
  template <class EyeSide>
  void draw_leaf(const Node& leaf, EyeSide&& eye_side) {
    if (clip_mask_ != 0) {
      for_fragments(frame_.reader.tree(), leaf, [&](const TreeFragment& f) {
        draw_any(f, eye_side);
        return true;
      });
      frame_.kernel.leave_leaf(screen_);
      return;
    }
    const Blocks blocks = frame_.reader.blocks(leaf);
    const Run run = {leaf.first_fragment, blocks.end};
    prefetch(run, 0, kAhead);
    prefetch_colors(run, 0, kColorsAhead);
    draw_blocks(blocks.triangles, frame_.kernel.draw_triangles, run, eye_side);
    draw_blocks(blocks.quadrangles, frame_.kernel.draw_quadrangles, run,
                eye_side);
    for_fragments(frame_.reader.tree(), blocks.rest,
                  [&](const TreeFragment& f) {
                    draw_any(f, eye_side);
                    return true;
                  });
    frame_.kernel.leave_leaf(screen_);
  }

  /// Paints what is unlit in the background's colour. Returns how many pixels
  /// that were.
  std::int64_t fill_rest(const Rgb& background) {
    const PixelSource source = {
        kBackground, packed_color(background.r, background.g, background.b), 0,
        0};
    return frame_.kernel.fill_rest(screen_, source);
  }

  /// Asks for the memory that drawing the leaf will read first.
  void prefetch(const Node& leaf) const;

  /// How often a pixel was set, but for what went to layers.
  std::size_t pixels() const { return pixels_; }
  std::size_t fragments() const { return fragments_; }
  /// Counts from there on.
  void set_fragments(std::size_t count) { fragments_ = count; }
  FilterStats stats() const {
    FilterStats all = stats_;
    all.add(depth_.stats());
    return all;
  }

 private:
  /// Where the corners of an outline go.
  static constexpr std::int32_t kMostCorners = 32;

  /// A fragment in the image: its corners are known, or its lines must be
  /// decided one by one, or nothing of it is seen.
  enum class Projection { kOutline, kLines, kUnseen };

  /// The fragments of a leaf that are in blocks: one after another.
  struct Run {
    std::int32_t first;
    std::int32_t end;
  };

  /// How many fragments ahead memory is fetched: the lists that lead to
  /// colours, then the colours. The processor drops fetches beyond what it can
  /// hold.
  static constexpr std::int32_t kAhead = 32;
  static constexpr std::int32_t kColorsAhead = 16;
  void prefetch(const Run& run, std::int32_t from, std::int32_t count) const;
  template <std::size_t kCorners>
  static void prefetch_block(const FragmentBlock<kCorners>& block) {
    const char* at = reinterpret_cast<const char*>(&block);
    for (std::size_t k = 0; k < sizeof(block); k += 64) {
      __builtin_prefetch(at + k);
    }
  }
  void prefetch_colors(const Run& run, std::int32_t from,
                       std::int32_t count) const;

  /// Draws a leaf's blocks, all of kCorners corners.
  template <std::size_t kCorners, class DrawBlock, class EyeSide>
  void draw_blocks(std::span<const FragmentBlock<kCorners>> blocks,
                   DrawBlock draw_block, const Run& run, EyeSide&& eye_side) {
    if (!blocks.empty()) screen_.most_masks = 1;
    for (const FragmentBlock<kCorners>& block : blocks) {
      const std::int32_t from = block.first_fragment - run.first;
      prefetch(run, from + kAhead, block.count);
      prefetch_colors(run, from + kColorsAhead, block.count);
      if (&block != &blocks.back()) prefetch_block(*(&block + 1));
      block_ = &block;
      const BlockDrawn drawn =
          draw_block(screen_, frame_.view, frame_.image.cull, block);
      block_ = nullptr;
      fragments_ += static_cast<std::size_t>(drawn.displayed);
      for (std::uint32_t left = drawn.left; left != 0; left &= left - 1) {
        draw_any(frame_.reader.fragments_of(block)[std::countr_zero(left)],
                 eye_side);
      }
    }
  }

  /// Scene::corner_colors(), in one step to memory where that is known.
  std::span<const Rgb> corner_colors(PolygonId polygon) const {
    const Scene& scene = frame_.reader.scene();
    if (!triangles_) return scene.corner_colors(polygon);
    return {scene.data().corner_colors.data() +
                3 * static_cast<std::size_t>(polygon),
            3};
  }

  Projection project(const TreeFragment& fragment);
  template <class VertexAt>
  Projection project(std::size_t count, VertexAt&& vertex_at);
  int turn(std::size_t count) const;
  void draw_projected(const TreeFragment& fragment, Projection projection,
                      int eye_sign);
  PixelSource start(const TreeFragment& fragment, int eye_sign);
  void start_shader(const TreeFragment& fragment, int eye_sign);
  void fetch(std::uint32_t some) const override;
  PixelSource begin(std::int32_t k, std::int32_t turn) override;
  PixelRange exact_line(std::int32_t j, PixelRange range) override;
  void nearer(std::int32_t other, std::int32_t x, std::int32_t y,
              std::uint32_t* lit) override {
    depth_.nearer(other - frame_.first_id, x, y, lit);
  }
  DepthDifference start_layer(const Layer& layer) override {
    depth_.start(*layer.fragment, layer.source.eye_sign, layer.block);
    return depth_.depth();
  }
  const Gradient& gradient() override { return shader_.gradient(); }
  void shade(const PixelSource& source, std::int32_t x, std::int32_t y,
             std::uint32_t bits, std::uint8_t* colors,
             std::int64_t at) override;
  void blend(std::int32_t x, std::int32_t y,
             const std::uint32_t* bits) override;

  const Frame& frame_;
  TileView& screen_;
  ExactScan<kBits> scan_;
  GouraudShader shader_;
  GouraudShader late_shader_;  ///< for what is written later
  PolygonId late_ = kBackground;
  bool gouraud_;
  /// Whether all polygons have three corners: the p-th those from 3 p on.
  bool triangles_;
  LeafLayers* layers_ = nullptr;
  Layer layer_;  ///< the fragment that was begun last
  double x_[kMostCorners];
  double y_[kMostCorners];
  std::size_t corner_count_ = 0;  ///< of the outline
  double error_ = 0;
  FragmentClipper clipper_;
  ClipMask clip_mask_ = 0;
  ClipMask cuts_ = 0;  ///< the planes that cut the fragment
  LeafDepth<kBits> depth_;
  const BlockHead* block_ = nullptr;  ///< the block being drawn, if any
  std::size_t pixels_ = 0;
  std::size_t fragments_ = 0;
  FilterStats stats_;
};

extern template class PolygonRasterizer<kMovedGrid>;
extern template class PolygonRasterizer<26>;
extern template class PolygonRasterizer<40>;
extern template class PolygonRasterizer<54>;

}  // namespace halfspace::fast
