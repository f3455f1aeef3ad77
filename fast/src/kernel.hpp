#pragma once

#include <cstdint>

#include "image_line.hpp"

namespace halfspace::fast {

/// A tile is 32 x 8 pixels: one word a line, least bit leftmost, 256 bits.
constexpr std::int32_t kTileWidth = 32;
constexpr std::int32_t kTileHeight = 8;

/// The screen that one thread fills: which pixels are lit, and the images.
///
/// Plain pointers, so that the inner loops can be compiled for several
/// instruction sets and share nothing else. Units: pixels, tiles.
struct Canvas {
  PixelRange columns;  ///< the columns asked for
  PixelRange lines;    ///< the lines of this thread, of those asked for
  std::int32_t tiles_across = 0;
  std::int32_t words_across = 0;   ///< of `open`, a tile row
  std::uint32_t* lit = nullptr;    ///< 8 words a tile, tile by tile
  std::uint64_t* open = nullptr;   ///< one bit a tile: some pixel is unlit
  std::int64_t open_tiles = 0;     ///< how many of those bits are set
  std::int32_t* items = nullptr;   ///< of pixel (0, 0), may be out of bounds
  std::uint8_t* colors = nullptr;  ///< the same; null: not wanted
  std::int64_t items_stride = 0;   ///< entries a line
  std::int64_t colors_stride = 0;  ///< bytes a line

  bool overwrite = false;  ///< back to front: paint the lit pixels, too

  /// Within a leaf, whose fragments hide each other in any order: the pixels
  /// that were lit when it began, kept for the tiles it has touched.
  bool in_leaf = false;
  std::uint32_t leaf = 0;            ///< its number
  std::uint32_t* leaf_of = nullptr;  ///< the leaf that touched the tile last
  std::uint32_t* before = nullptr;   ///< lit, when that leaf touched it first
  std::int32_t* full = nullptr;      ///< tiles to be closed after the leaf
  std::int32_t full_count = 0;
};

/// A convex polygon in the image, each corner off by at most `error` in x and
/// in y; turning from x to y if `turn` is positive, else the other way.
struct Outline {
  const double* x = nullptr;
  const double* y = nullptr;
  std::int32_t count = 0;
  double error = 0;
  std::int32_t turn = 1;
};

/// What the loops ask back where doubles cannot tell.
struct Decider {
  /// The pixels of line `j` whose samples the polygon covers, of `range`.
  PixelRange (*exact_line)(void* context, std::int32_t j, PixelRange range);
  /// Of the pixels `lit` (8 words) of the tile with the left top pixel (x, y),
  /// lit by this leaf, those where this polygon is nearer: left in `lit`.
  void (*nearer)(void* context, std::int32_t x, std::int32_t y,
                 std::uint32_t* lit);
  /// Colours the pixels `lit` of a tile; null: flat colour.
  void (*shade)(void* context, std::int32_t x, std::int32_t y,
                const std::uint32_t* lit);
  void* context;
};

/// What is written where a polygon lights a pixel.
struct Ink {
  std::int32_t id = 0;
  std::uint8_t rgb[3] = {0, 0, 0};
};

/// The inner loops for one instruction set.
struct Kernel {
  /// Lights and paints what the outline covers of the unlit pixels. Returns
  /// how many pixels that was.
  std::int64_t (*draw)(Canvas& canvas, const Outline& outline, const Ink& ink,
                       const Decider& decider);
  /// The same for an outline that is known only line by line, exactly.
  std::int64_t (*draw_lines)(Canvas& canvas, PixelRange lines, const Ink& ink,
                             const Decider& decider);
  /// Whether a tile that meets the rectangle is open.
  bool (*any_open)(const Canvas& canvas, PixelRange columns, PixelRange lines);
  /// Paints every unlit pixel.
  void (*fill_rest)(Canvas& canvas, const Ink& ink);
};

extern const Kernel kPlainKernel;  ///< runs everywhere
#if defined(__x86_64__)
extern const Kernel kAvx2Kernel;  ///< needs AVX2
#endif

/// The best kernel that this machine runs.
const Kernel& best_kernel();

}  // namespace halfspace::fast
