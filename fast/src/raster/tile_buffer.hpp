#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "halfspace/fast/render.hpp"
#include "raster/kernel/tile_kernel.hpp"

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

/// The memory of a buffer.
struct TileMemory : LitMemory {
  /// An array that is not initialised: what is not used is not touched.
  template <class T>
  class Array {
   public:
    T* get() const { return values_.get(); }
    std::int32_t count() const { return count_; }
    /// Makes it `wanted` long, the first `kept` values as they were.
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

  std::vector<MaskList> mask_lists;
  std::vector<std::uint32_t> leaf_of;
  Array<std::uint32_t> before;
  Array<std::int32_t> touched;
  Array<CoverageMask> masks;
  Array<PixelSource> sources;
  Array<Gradient> gradients;
  std::vector<std::uint16_t> sums;
  alignas(32) std::int32_t tile_items[kTileWidth * kTileHeight] = {};
  alignas(32) std::uint8_t tile_colors[3 * kTileWidth * kTileHeight] = {};
};

/// The tiles of one thread's lines.
class TileBuffer {
 public:
  /// All pixels of `rectangle` within `lines` unlit, all others lit.
  /// The images that `result` has are of the rectangle's size.
  TileBuffer(const Rectangle& rectangle, PixelRange lines, Rendering& result,
             bool with_leaves);
  ~TileBuffer();
  TileBuffer(const TileBuffer&) = delete;
  TileBuffer& operator=(const TileBuffer&) = delete;

  TileView& view() { return view_; }

  /// From here on colours of so many samples a pixel each way are added up.
  /// Requires: there are no images.
  void add_up(std::int32_t samples);

  /// From here to TileKernel::leave_leaf() fragments may hide each other in any
  /// order.
  void enter_leaf();

 private:
  TileView view_;
  std::unique_ptr<TileMemory> memory_;
};

}  // namespace halfspace::fast
