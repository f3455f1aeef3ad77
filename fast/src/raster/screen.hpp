#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "halfspace/fast/render.hpp"
#include "raster/kernel/kernel.hpp"

namespace halfspace::fast {

/// The memory of tiles' bits.
struct LitMemory {
  std::vector<std::uint32_t> lit;
  std::vector<std::uint64_t> open;
};

/// Lays out tiles over the lines and makes all pixels of `rectangle` within
/// them unlit, all others lit: what is not wanted counts as lit.
void make_unlit(LitTiles& screen, LitMemory& memory, const Rectangle& rectangle,
                PixelRange lines);

/// What a screen needs memory for.
struct ScreenMemory : LitMemory {
  /// Memory of so many numbers, which need not be told.
  template <class T>
  class Room {
   public:
    T* get() const { return values_.get(); }
    std::int32_t count() const { return count_; }
    /// Room for `wanted` of them, the first `kept` as they were.
    void grow(std::int32_t wanted, std::int32_t kept) {
      if (wanted <= count_) return;
      auto values =
          std::make_unique_for_overwrite<T[]>(static_cast<std::size_t>(wanted));
      std::copy_n(values_.get(), kept, values.get());
      values_ = std::move(values);
      count_ = wanted;
    }

   private:
    std::unique_ptr<T[]> values_;
    std::int32_t count_ = 0;
  };

  std::size_t bytes() const;

  std::vector<Pieces> pieces_of;
  std::vector<std::uint32_t> leaf_of;
  // What is not used is not touched either.
  Room<std::uint32_t> before;
  Room<std::int32_t> touched;
  Room<LitPiece> pieces;
  Room<Ink> inks;
  Room<Gradient> gradients;
  alignas(32) std::int32_t tile_items[kTileWidth * kTileHeight] = {};
  alignas(32) std::uint8_t tile_colors[3 * kTileWidth * kTileHeight] = {};
};

/// The tiles of one thread's lines, and the canvas over them.
class Screen {
 public:
  /// All pixels of `rectangle` within `lines` unlit, all others lit.
  /// The images that `result` has are of the rectangle's size.
  Screen(const Rectangle& rectangle, PixelRange lines, Rendering& result,
         bool with_leaves);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  Canvas& canvas() { return canvas_; }

  /// From here to Kernel::leave_leaf() fragments may hide each other in any
  /// order.
  void enter_leaf();

 private:
  void make_room(Room what);

  Canvas canvas_;
  std::unique_ptr<ScreenMemory> memory_;
};

}  // namespace halfspace::fast
