#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "halfspace/fast/render.hpp"
#include "kernel.hpp"

namespace halfspace::fast {

/// The tiles of one thread's lines, and the canvas over them.
class Screen {
 public:
  /// All pixels of `rectangle` within `lines` unlit, all others lit.
  /// The images that `result` has are of the rectangle's size.
  Screen(const Rectangle& rectangle, PixelRange lines, Rendering& result,
         bool with_leaves);
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  Canvas& canvas() { return canvas_; }

  /// From here to Kernel::leave_leaf() fragments may hide each other in any
  /// order.
  void enter_leaf();

 private:
  void light_outside(const Rectangle& rectangle, PixelRange lines);
  void make_room(Room what);

  Canvas canvas_;
  std::vector<std::uint32_t> lit_;
  std::vector<std::uint64_t> open_;
  std::vector<Pieces> pieces_of_;
  std::vector<std::uint32_t> leaf_of_;
  // What is not used is not touched either.
  std::unique_ptr<std::uint32_t[]> before_;
  std::unique_ptr<std::int32_t[]> touched_;
  std::unique_ptr<Piece[]> pieces_;
  std::unique_ptr<Ink[]> inks_;
  std::unique_ptr<Gradient[]> gradients_;
  alignas(32) std::int32_t tile_items_[kTileWidth * kTileHeight] = {};
  alignas(32) std::uint8_t tile_colors_[3 * kTileWidth * kTileHeight] = {};
};

}  // namespace halfspace::fast
