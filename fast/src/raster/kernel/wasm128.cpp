#include "raster/kernel/tile_kernel.hpp"

#if defined(__wasm_simd128__)
#include "raster/kernel/generic/scalar_pixels.hpp"
#include "raster/kernel/generic/small_polygons.hpp"
#include "raster/kernel/generic/tile_rows.hpp"
#include "raster/kernel/wasm/box_test.hpp"
#include "raster/kernel/wasm/registers.hpp"

namespace halfspace::fast {
namespace {

/// What the loops of generic/ take from WebAssembly.
struct Wasm128Simd : Registers, ScalarPixels {
  /// Means are made of items: sums would be more code.
  static constexpr bool kAddsUp = false;

  /// Writes a colour into pixels of a tile.
  static void put_runs(const TileView& screen, std::int32_t x, std::int32_t y,
                       const Words8& pixels, std::uint32_t packed) {
    alignas(16) std::uint32_t bits[kTileHeight];
    store(bits, pixels);
    const FlatColor color = flat_color(packed);
    for (std::int32_t r = 0; r < kTileHeight; ++r) {
      if (bits[r] != 0)
        store_colors(screen.colors, 3 * screen.pixel_at(x, y + r), bits[r],
                     color, false);
    }
  }
};

}  // namespace

const TileKernel kWasm128Kernel =
    table_of<SmallPolygons<WasmBoxTest<TileRows<Wasm128Simd>>>>();

}  // namespace halfspace::fast
#endif
