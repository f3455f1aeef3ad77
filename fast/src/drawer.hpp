#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "exact_scan.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/image.hpp"
#include "kernel.hpp"
#include "shader.hpp"
#include "view.hpp"
#include "walk.hpp"

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
    const BspTree& tree = frame_.reader.tree();
    std::int32_t ahead = leaf.first_fragment;
    for (int k = 0; k < kAhead && ahead != kNoFragment; ++k) {
      ahead = tree.fragments[static_cast<std::size_t>(ahead)].next;
    }
    for_fragments(tree, leaf, [&](const TreeFragment& f) {
      if (ahead != kNoFragment) {
        const auto& later = tree.fragments[static_cast<std::size_t>(ahead)];
        prefetch(later);
        ahead = later.next;
      }
      if (f.corner_count > 4) {
        draw_any(f, eye_side);
        return true;
      }
      Gathered& gathered = gathered_[f.corner_count - 3];
      gather(f, gathered);
      if (gathered.polygons.count == SmallPolygons::kMost) {
        draw_gathered(gathered, eye_side);
      }
      return true;
    });
    for (Gathered& gathered : gathered_) draw_gathered(gathered, eye_side);
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

  /// Fragments that are drawn together.
  struct Gathered {
    SmallPolygons polygons;
    const TreeFragment* fragments[SmallPolygons::kMost];
  };

  void gather(const TreeFragment& fragment, Gathered& gathered) const;

  /// So many fragments ahead memory is asked for: more at a time than can be
  /// under way is asked for in vain.
  static constexpr int kAhead = 16;
  void prefetch(const TreeFragment& fragment) const;

  /// Fewer than this are sooner drawn one by one.
  static constexpr std::int32_t kFew = 4;

  template <class EyeSide>
  void draw_gathered(Gathered& gathered, EyeSide&& eye_side) {
    SmallPolygons& polygons = gathered.polygons;
    if (polygons.count < kFew) {
      for (std::int32_t k = 0; k < polygons.count; ++k) {
        draw_any(*gathered.fragments[k], eye_side);
      }
    } else {
      draw_small(gathered);
      for (std::int32_t k = 0; k < polygons.left_count; ++k) {
        draw_any(*gathered.fragments[polygons.left[k]], eye_side);
      }
    }
    polygons.count = 0;
  }
  void draw_small(Gathered& gathered);

  Fate project(const TreeFragment& fragment);
  int turn(std::size_t count) const;
  void draw_projected(const TreeFragment& fragment, Fate fate, int eye_sign);
  Ink start(const TreeFragment& fragment, int eye_sign);
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
    OrderLine line;          ///< positive where the fragment at hand is nearer
  };
  Rival& rival(PolygonId other);
  const OrderLine* depth(PolygonId polygon);
  bool compare_depths(Rival& entry);
  void compare_planes(Rival& entry);
  const SeenApproximately& seen(PolygonId polygon);
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
  /// Planes that were seen lately.
  struct Seen {
    PolygonId polygon = kBackground;
    bool ready = false;
    const TreeFragment* fragment = nullptr;  ///< of the polygon, if known
    bool has_depth = false;
    SeenApproximately plane;
    OrderLine depth;  ///< of the fragment
  };
  std::vector<Seen> seen_;
  std::array<Gathered, 2> gathered_;  ///< triangles, quadrangles
  const Gathered* drawn_ = nullptr;   ///< those that are being drawn
  std::size_t pixels_ = 0;
  std::size_t fragments_ = 0;
  FilterStats stats_;
};

extern template class Drawer<26>;
extern template class Drawer<40>;
extern template class Drawer<54>;

}  // namespace halfspace::fast
