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

  /// Asks for the memory that drawing the fragment will read.
  void prefetch(const TreeFragment& fragment) const {
    for (const Corner& corner : frame_.reader.corners(fragment)) {
      __builtin_prefetch(frame_.reader.address(corner.vertex));
    }
  }

  std::size_t pixels() const { return pixels_; }
  std::size_t fragments() const { return fragments_; }
  const FilterStats& stats() const { return stats_; }

 private:
  /// Where the corners of an outline go.
  static constexpr std::int32_t kMostCorners = 32;

  enum class Fate { kOutline, kLines, kUnseen };

  Fate project(const TreeFragment& fragment);
  int turn(std::size_t count) const;
  void draw_projected(const TreeFragment& fragment, Fate fate, int eye_sign);
  static PixelRange exact_line(void* self, std::int32_t j, PixelRange range);
  static void nearer(void* self, std::int32_t x, std::int32_t y,
                     std::uint32_t* lit);
  static void shade(void* self, std::int32_t x, std::int32_t y,
                    const std::uint32_t* lit);
  static void blend(void* self, std::int32_t x, std::int32_t y,
                    const std::uint32_t* lit);
  bool is_nearer(PolygonId other, std::int32_t i, std::int32_t j);

  /// How the fragment at hand lies to a polygon that it contests pixels with.
  struct Rival {
    PolygonId polygon = kBackground;
    OrderLine line;  ///< positive where the fragment at hand is nearer
  };
  const Rival& rival(PolygonId other);

  const Frame& frame_;
  Canvas& canvas_;
  ExactScan<kBits> scan_;
  Shader shader_;
  bool gouraud_;
  const TreeFragment* fragment_ = nullptr;
  int eye_sign_ = 0;
  bool shaded_ = false;  ///< else in one colour
  Rgb color_;
  double x_[kMostCorners];
  double y_[kMostCorners];
  double error_ = 0;
  bool seen_ready_ = false;
  SeenApproximately seen_;
  std::array<Rival, 16> rivals_;
  std::size_t pixels_ = 0;
  std::size_t fragments_ = 0;
  FilterStats stats_;
};

extern template class Drawer<26>;
extern template class Drawer<40>;
extern template class Drawer<54>;

}  // namespace halfspace::fast
