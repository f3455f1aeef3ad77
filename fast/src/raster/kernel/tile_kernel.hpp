#pragma once

#include <cstddef>
#include <cstdint>

#include "camera/edge_function.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/simd.hpp"
#include "raster/kernel/tile_view.hpp"

namespace halfspace::fast {

struct View;

/// A convex polygon in the image, each corner off by at most `error` in x and
/// in y; turning from x to y if `turn` is positive, else the other way.
struct Outline {
  const double* x = nullptr;
  const double* y = nullptr;
  std::int32_t count = 0;
  double error = 0;
  std::int32_t turn = 1;
};

/// The fragments of a block that were drawn, and those that are left.
struct BlockDrawn {
  std::int32_t displayed = 0;  ///< how many were displayed, seen or not
  std::uint32_t left = 0;      ///< the bits of those that need more than this
};

/// What the loops ask about the polygon that they draw: where doubles cannot
/// decide, and its colours.
class ExactFallback {
 public:
  /// Begins to fetch what the next functions read of those fragments of a block
  /// that have a bit in `some`.
  virtual void fetch(std::uint32_t some) const = 0;
  /// Begins the k-th fragment of a block, which turns as an Outline does.
  virtual PixelSource begin(std::int32_t k, std::int32_t turn) = 0;
  /// The pixels of line `j` whose samples the polygon covers, of `range`.
  virtual PixelRange exact_line(std::int32_t j, PixelRange range) = 0;
  /// Leaves of the pixels `lit` (8 words) of the tile with the left top pixel
  /// (x, y), which show polygon `other`, those where this polygon is nearer.
  virtual void nearer(std::int32_t other, std::int32_t x, std::int32_t y,
                      std::uint32_t* lit) = 0;
  /// The polygon's colours, where they are smooth.
  virtual const Gradient& gradient() = 0;
  /// Colours the pixels `bits` of line y from column x on one by one, in the
  /// source's colours; column x is at byte `at`.
  virtual void shade(const PixelSource& source, std::int32_t x, std::int32_t y,
                     std::uint32_t bits, std::uint8_t* colors,
                     std::int64_t at) = 0;
  /// Shows the polygon in the pixels `bits` (8 words) of a tile. Requires:
  /// blends.
  virtual void blend(std::int32_t x, std::int32_t y,
                     const std::uint32_t* bits) = 0;

  bool blends = false;  ///< whether polygons back to front go to blend()

 protected:
  ~ExactFallback() = default;
};

/// A view in floats, for boxes. A quotient x / t or y / t of a point with t
/// beyond `least` is off by less than a tenth of a pixel, if it matters.
struct BoxView {
  float x[4] = {0, 0, 0, 0};  ///< the factors of a point, and what is added
  float y[4] = {0, 0, 0, 0};
  float t[4] = {0, 0, 0, 0};
  float least = 0;
};

/// Whether something in a box can light a pixel.
enum class BoxVisibility : std::uint8_t { kHidden, kVisible, kUnknown };

/// The loops over tiles for one instruction set (docs/tile-kernel.md).
struct TileKernel {
  /// Lights the pixels from first[r] up to end[r] of the 8 lines r of a tile
  /// row that are on the screen. `now`, 8 words for each tile of the row, gets
  /// what becomes lit; tiles where nothing does are left as they are.
  void (*light)(LitTiles& screen, std::int32_t row, const std::uint32_t* first,
                const std::uint32_t* end, std::uint32_t* now);
  /// Lights and paints what the outline covers of the unlit pixels. Returns
  /// how many pixels that was if screen.overwrite, else 0.
  std::int64_t (*draw)(TileView& screen, const Outline& outline,
                       const PixelSource& source);
  /// The same for an outline that is known only line by line, exactly.
  std::int64_t (*draw_lines)(TileView& screen, PixelRange lines,
                             const PixelSource& source);
  /// The same for the fragments of a block of a leaf, seen in the view, `cull`
  /// leaving out those that the eye is on the negative side of.
  BlockDrawn (*draw_triangles)(TileView& screen, const View& view, bool cull,
                               const FragmentBlock<3>& block);
  BlockDrawn (*draw_quadrangles)(TileView& screen, const View& view, bool cull,
                                 const FragmentBlock<4>& block);
  /// Whether a tile that meets the rectangle is open.
  bool (*any_open)(const TileView& screen, PixelRange columns,
                   PixelRange lines);
  /// Whether a pixel of the rectangle is unlit. Requires: not in a leaf.
  bool (*any_unlit)(const TileView& screen, PixelRange columns,
                    PixelRange lines);
  /// Whether something in the box can light a pixel. Requires: not in a leaf.
  BoxVisibility (*box_visibility)(const TileView& screen, const BoxView& view,
                                  const Box& box);
  /// Ends a leaf: closes tiles that it has filled.
  void (*leave_leaf)(TileView& screen);
  /// Paints every unlit pixel, and writes what is not written yet. Returns how
  /// many there were.
  std::int64_t (*fill_rest)(TileView& screen, const PixelSource& source);

  /// Writes the means of all pixels of the screen's columns and lines, where
  /// samples' colours were added up (TileImages::sums); all of them are lit.
  /// The first pixel of the columns, of line `top`, is at `means`.
  void (*write_means)(const TileView& screen, std::uint8_t* means);

  // Means of 2 x 2, 4 x 4 or 8 x 8 samples (S5.7); null: there are no such
  // loops, and SampleMeans has its own.

  /// Means of `count` pixels that see one smooth polygon, the first of which
  /// begins at sample (i, j). Returns how many of them, from the first on, are
  /// decided and written.
  std::int32_t (*full_means)(const Gradient& gradient, std::int32_t samples,
                             std::int32_t i, std::int32_t j, std::int32_t count,
                             std::uint8_t* means) = nullptr;
  /// The mean of a pixel that begins at sample (i, j): of the parts and of
  /// other samples, of which `whole` (4 words, the last 0) are the sums of
  /// channels. False: not decided, and nothing written.
  bool (*mixed_mean)(const MeanPart* parts, std::int32_t part_count,
                     const std::int32_t* whole, std::int32_t samples,
                     std::int32_t i, std::int32_t j,
                     std::uint8_t* mean) = nullptr;
};

/// The table of a kernel's functions.
template <class Kernel>
constexpr TileKernel table_of() {
  return {Kernel::light,
          Kernel::draw,
          Kernel::draw_lines,
          Kernel::template draw_block<3>,
          Kernel::template draw_block<4>,
          Kernel::any_open,
          Kernel::any_unlit,
          Kernel::box_visibility,
          Kernel::leave_leaf,
          Kernel::fill_rest,
          Kernel::write_means};
}

extern const TileKernel kPortableKernel;
#if defined(__x86_64__)
extern const TileKernel kAvx2Kernel;
extern const TileKernel kAvx512Kernel;
#elif defined(__wasm_simd128__)
extern const TileKernel kWasm128Kernel;
#endif

/// The kernel of the level, or the best below it that this processor has.
const TileKernel& best_kernel(SimdLevel level = SimdLevel::kBest);

}  // namespace halfspace::fast
