#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/view.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/image.hpp"
#include "raster/exact_coverage.hpp"
#include "raster/kernel/kernel.hpp"
#include "raster/shader.hpp"
#include "tree/traversal.hpp"

namespace halfspace::fast {

/// What all threads of one frame share.
struct Frame {
  const TreeReader& reader;
  const CameraData& camera;
  const ImageOptions& image;
  const View& view;
  const Kernel& kernel;
  std::uint8_t alpha = kOpaque;  ///< below that colours are blended (S5.6)
};

/// Draws the fragments of a tree on one canvas.
template <int kBits>
class Drawer {
 public:
  Drawer(const Frame& frame, Canvas& canvas);

  /// Draws a fragment whose source has the eye on side `eye_sign`.
  void draw(const TreeFragment& fragment, int eye_sign);

  /// Draws one for which that is not known: eye_side(fragment) tells, and is
  /// asked only where its outline does not.
  template <class EyeSide>
  void draw_any(const TreeFragment& fragment, EyeSide&& eye_side) {
    const Fate fate = project(fragment);
    if (fate == Fate::kUnseen) return;
    int sign = fate == Fate::kOutline ? turn(fragment.corner_count) : 0;
    sign = sign != 0 ? -frame_.view.orientation * sign : eye_side(fragment);
    if (sign == 0 || (frame_.image.cull && sign < 0)) return;
    draw_projected(fragment, fate, sign);
  }

  /// Draws the fragments of a leaf, whose order does not matter.
  template <class EyeSide>
  void draw_leaf(const Node& leaf, EyeSide&& eye_side) {
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
    frame_.kernel.leave_leaf(canvas_, decider_);
  }

  /// Paints what is unlit in the background's colour. Returns how many pixels
  /// that were.
  std::int64_t fill_rest(const Rgb& background) {
    const Ink ink = {kBackground,
                     packed_color(background.r, background.g, background.b), 0,
                     0};
    return frame_.kernel.fill_rest(canvas_, ink, decider_);
  }

  /// Asks for the memory that drawing the leaf will read first.
  void prefetch(const Node& leaf) const;

  std::size_t pixels() const { return pixels_; }
  std::size_t fragments() const { return fragments_; }
  const FilterStats& stats() const { return stats_; }

 private:
  /// Where the corners of an outline go.
  static constexpr std::int32_t kMostCorners = 32;

  enum class Fate { kOutline, kLines, kUnseen };

  /// The fragments of a leaf that are in blocks: one after another.
  struct Run {
    std::int32_t first;
    std::int32_t end;
  };

  /// So many fragments ahead memory is asked for: what leads to colours, and
  /// then those. More at a time than can be under way is asked for in vain.
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

  /// Draws a leaf's blocks, all of so many corners.
  template <std::size_t kCorners, class DrawBlock, class EyeSide>
  void draw_blocks(std::span<const FragmentBlock<kCorners>> blocks,
                   DrawBlock draw_block, const Run& run, EyeSide&& eye_side) {
    if (!blocks.empty()) canvas_.most_pieces = 1;
    for (const FragmentBlock<kCorners>& block : blocks) {
      const std::int32_t from = block.first_fragment - run.first;
      prefetch(run, from + kAhead, block.count);
      prefetch_colors(run, from + kColorsAhead, block.count);
      if (&block != &blocks.back()) prefetch_block(*(&block + 1));
      at_hand_ = &block;
      const BlockDrawn drawn =
          draw_block(canvas_, frame_.view, frame_.image.cull, block, decider_);
      at_hand_ = nullptr;
      fragments_ += static_cast<std::size_t>(drawn.displayed);
      for (std::uint32_t left = drawn.left; left != 0; left &= left - 1) {
        draw_any(fragments_of(block)[std::countr_zero(left)], eye_side);
      }
    }
  }

  const TreeFragment* fragments_of(const BlockHead& block) const {
    return frame_.reader.tree().fragments.data() + block.first_fragment;
  }
  template <std::size_t kCorners>
  static const FragmentBlock<kCorners>& with(const BlockHead& block) {
    return static_cast<const FragmentBlock<kCorners>&>(block);
  }

  Fate project(const TreeFragment& fragment);
  int turn(std::size_t count) const;
  void draw_projected(const TreeFragment& fragment, Fate fate, int eye_sign);
  Ink start(const TreeFragment& fragment, int eye_sign);
  void start_shader(const TreeFragment& fragment, int eye_sign);
  static Ink begin(void* self, std::int32_t k, std::int32_t turn);
  static PixelRange exact_line(void* self, std::int32_t j, PixelRange range);
  static void nearer(void* self, std::int32_t other, std::int32_t x,
                     std::int32_t y, std::uint32_t* lit);
  static const Gradient& gradient(void* self);
  static void shade(void* self, const Ink& ink, std::int32_t x, std::int32_t y,
                    std::uint32_t bits, std::uint8_t* colors, std::int64_t at);
  static void blend(void* self, std::int32_t x, std::int32_t y,
                    const std::uint32_t* bits);
  bool is_nearer(PolygonId other, std::int32_t i, std::int32_t j);

  /// How the fragment at hand lies to a polygon that it contests pixels with.
  struct Rival {
    PolygonId polygon = kBackground;
    std::uint32_t serial = 0;
    bool by_depths = false;  ///< planes may tell more
    DepthDifference line;    ///< positive where the fragment at hand is nearer
  };
  Rival& rival(PolygonId other);
  struct Seen;
  void collect_corners(const Seen& entry);
  const DepthDifference* depth(PolygonId polygon);
  bool compare_depths(Rival& entry);
  void compare_planes(Rival& entry);
  const ApproximateProjection& seen(PolygonId polygon);
  Plane plane_of(PolygonId polygon, const TreeFragment* fragment) const;

  const Frame& frame_;
  Canvas& canvas_;
  ExactScan<kBits> scan_;
  Shader shader_;
  Shader late_shader_;  ///< for what is written later
  PolygonId late_ = kBackground;
  bool gouraud_;
  const TreeFragment* fragment_ = nullptr;
  int eye_sign_ = 0;
  Ink ink_;  ///< of the last that was not drawn together with others
  double x_[kMostCorners];
  double y_[kMostCorners];
  double error_ = 0;
  Decider decider_;
  std::uint32_t serial_ = 0;  ///< of the fragment at hand
  std::array<Rival, 16> rivals_;
  /// Polygons that were seen lately: what each that is drawn changes, and apart
  /// from it, to keep that near, what few are asked for.
  struct Seen {
    PolygonId polygon = kBackground;
    bool has_plane = false;
    bool has_depth = false;
    const TreeFragment* fragment = nullptr;  ///< of the polygon, if known
    const BlockHead* block = nullptr;        ///< the fragment's, if it has one
  };
  struct Depths {
    ApproximateProjection plane;
    DepthDifference depth;  ///< of the fragment
  };
  static constexpr std::size_t kSeenPolygons = 512;
  static std::size_t place_of(PolygonId polygon) {
    return static_cast<std::size_t>(polygon) % kSeenPolygons;
  }
  std::vector<Seen> seen_;
  std::vector<Depths> depths_;
  std::vector<Vertex> corners_;         ///< of a fragment
  const BlockHead* at_hand_ = nullptr;  ///< the block being drawn, if any
  std::size_t pixels_ = 0;
  std::size_t fragments_ = 0;
  FilterStats stats_;
};

extern template class Drawer<26>;
extern template class Drawer<40>;
extern template class Drawer<54>;

}  // namespace halfspace::fast
