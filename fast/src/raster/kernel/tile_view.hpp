#pragma once

#include <cstdint>

#include "camera/edge_function.hpp"

namespace halfspace::fast {

/// A tile is 32 x 8 pixels: one word a line, least bit leftmost, 256 bits.
constexpr std::int32_t kTileWidth = 32;
constexpr std::int32_t kTileHeight = 8;

/// How many sums of channels a tile has for so many samples each way.
constexpr std::int32_t sums_per_tile(std::int32_t samples) {
  return samples == 8 ? 16 : 3 * kTileWidth * kTileHeight / (samples * samples);
}

/// The id and the colours of a polygon, where it lights pixels.
///
/// Whole words: bytes that are written one by one are slow to read together.
struct PixelSource {
  std::int32_t id = 0;
  std::uint32_t color = 0;    ///< packed_color(), or kSmooth
  std::int32_t eye_sign = 0;  ///< the side of it that the eye is on
  std::int32_t uses = 0;      ///< masks that have it, or the next spare source

  /// The colours are those of ExactFallback::gradient().
  static constexpr std::uint32_t kSmooth = ~std::uint32_t{0};
  [[gnu::always_inline]] bool smooth() const { return color == kSmooth; }
};

/// A colour in a word, red in its lowest byte.
constexpr std::uint32_t packed_color(std::uint32_t red, std::uint32_t green,
                                     std::uint32_t blue) {
  return red | (green << 8) | (blue << 16);
}

/// The colours of a triangle (S5.4): a channel is its sum over the total, and
/// off by at most `doubt` over the total.
///
/// Three sums and the total, each a i + b j + c at the centre of pixel (i, j).
struct Gradient {
  alignas(32) double a[4];
  alignas(32) double b[4];
  alignas(32) double c[4];
  double doubt = 0;
};

/// Of some samples of a pixel, which see one polygon: their count, and the sums
/// of their places, in halves of samples from the pixel's centre, of the
/// squares of these and of their products.
struct Moments {
  std::int32_t n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

/// The samples of a pixel that see one smooth polygon.
struct MeanPart {
  const Gradient* gradient = nullptr;
  Moments moments;
};

/// No mask, no source.
constexpr std::int32_t kNone = -1;

/// A coverage mask (GRE96): the pixels that a polygon has lit of a tile, kept
/// until its colours are written or, where they are already, until the
/// polygon's leaf ends.
struct CoverageMask {
  std::uint32_t lit[8];
  std::int32_t id = 0;          ///< the polygon
  std::uint32_t color = 0;      ///< as of a source, or kWritten
  std::int32_t source = kNone;  ///< where it is kept, if it is smooth
  std::int32_t next = 0;        ///< lit before it, of the same tile

  static constexpr std::uint32_t kWritten = PixelSource::kSmooth - 1;
  [[gnu::always_inline]] bool is_written() const { return color == kWritten; }
};

/// A tile with this many masks is written, though it is open.
constexpr std::int32_t kMostMasks = 8;

/// The masks of a tile: those that were lit last and first, their number, how
/// many of them are written, and how many have sources that are kept.
struct MaskList {
  std::int32_t newest = kNone;
  std::int32_t oldest = kNone;
  std::int32_t count = 0;
  std::int32_t written = 0;
  std::int32_t with_source = 0;
};

// The parts of a view are plain pointers, which share no code between files
// that are compiled for different instructions: what members there are is
// inlined for certain. Units: pixels, tiles.

/// Which pixels are lit: the dynamic screen (S4.8), by tiles. What is off the
/// screen is lit.
struct LitTiles {
  std::int32_t first_row = 0;  ///< the tile row at which tiles are counted
  std::int32_t tiles_across = 0;
  std::int32_t words_across = 0;  ///< of `open`, a tile row
  std::uint32_t* lit = nullptr;   ///< 8 words a tile, tile by tile
  std::uint64_t* open = nullptr;  ///< one bit a tile: some pixel is unlit
  std::int64_t open_tiles = 0;    ///< how many of those bits are set
  std::int64_t touches = 0;       ///< how often a polygon lit pixels of a tile

  [[gnu::always_inline]] std::int64_t tile_at(std::int32_t row,
                                              std::int32_t tile) const {
    return std::int64_t{row - first_row} * tiles_across + tile;
  }
  [[gnu::always_inline]] std::int64_t open_at(std::int32_t row) const {
    return std::int64_t{row - first_row} * words_across;
  }
};

/// The images, and the part of them that one thread fills.
struct TileImages {
  PixelRange columns;              ///< the columns asked for: of the images
  PixelRange lines;                ///< the lines of this thread
  std::int32_t top = 0;            ///< the line at which the images begin
  std::int32_t* items = nullptr;   ///< null: not wanted
  std::uint8_t* colors = nullptr;  ///< null: not wanted
  std::int64_t width = 0;          ///< of the images
  bool overwrite = false;  ///< back to front: paint the lit pixels at once
  /// In place of images: the sums of the colours of each pixel's samples, all
  /// of which are flat, tile by tile; null: not wanted. Not back to front.
  std::uint16_t* sums = nullptr;
  std::int32_t samples = 1;  ///< of a pixel, each way
  /// Where a tile is put together, line by line.
  std::int32_t* tile_items = nullptr;
  std::uint8_t* tile_colors = nullptr;

  /// The sums of a tile.
  [[gnu::always_inline]] std::uint16_t* sums_of(std::int64_t index) const {
    return sums + index * sums_per_tile(samples);
  }

  /// Where a pixel is in the images.
  [[gnu::always_inline]] std::int64_t pixel_at(std::int32_t x,
                                               std::int32_t y) const {
    return (y - top) * width + (x - columns.first);
  }
};

struct TileMemory;
class ExactFallback;

/// The masks of the tiles, and the sources of those that are smooth.
struct MaskPool {
  MaskList* mask_lists = nullptr;  ///< a tile's
  CoverageMask* masks = nullptr;
  std::int32_t mask_count = 0;      ///< those that have been used
  std::int32_t mask_capacity = 0;   ///< those that there is memory for
  std::int32_t spare_mask = kNone;  ///< masks that may be used again
  PixelSource* sources = nullptr;
  Gradient* gradients = nullptr;  ///< of the sources
  std::int32_t source_count = 0;
  std::int32_t source_capacity = 0;
  std::int32_t spare_source = kNone;
  std::int32_t current_source = kNone;  ///< the polygon's own, if it is kept
  /// The colours of the polygon's corners, if it is a whole triangle of a block
  /// and smooth; else null.
  const std::uint8_t* corner_colors = nullptr;
  /// The colours of the polygon that is drawn, where the kernel knows them.
  const Gradient* gradient = nullptr;
  std::int32_t last_source = kNone;  ///< the last that was kept
  TileMemory* memory = nullptr;      ///< where all this lies
};

/// Make room for more.
void grow_masks(MaskPool& pool);
void grow_sources(MaskPool& pool);

/// A leaf, whose fragments hide each other in any order: the pixels that were
/// lit when it began, kept for the tiles that it has touched.
struct LeafState {
  bool in_leaf = false;
  std::uint32_t leaf = 0;            ///< its number
  std::uint32_t* leaf_of = nullptr;  ///< the leaf that touched the tile last
  std::uint32_t* before = nullptr;   ///< lit, when that leaf touched it first
  std::int32_t* touched = nullptr;   ///< tiles that the leaf has touched
  std::int32_t touched_count = 0;
  /// How many tiles the last leaves touched, and the masks there, each leaf
  /// counting a little less than the next.
  float recent_tiles = 0;
  float recent_masks = 0;
  /// A tile with this many masks is written when the leaf ends. 1 where its
  /// polygons are small: then there are many sources, which need not be kept.
  std::int32_t most_masks = kMostMasks;
};

/// The screen that one thread fills: which pixels are lit, and the images.
///
/// Front to back a tile keeps a list of masks, and is written when all of it is
/// lit, or the list is long: the images are hardly read back, and mostly
/// written 32 pixels at a time.
struct TileView : LitTiles, TileImages, MaskPool, LeafState {
  ExactFallback* exact = nullptr;  ///< asked about the polygon that is drawn
};

/// Where the colours of a tile go: its pixel (k, r) is at byte
/// at + r stride + 3 k. `whole`: all are there; else its columns from `first`
/// to `end`. `loose`: the pixels next to a polygon's may be written over;
/// `own`: they may be written again as they were, all over the tile.
struct Target {
  std::uint8_t* colors;
  std::int64_t at;
  std::int64_t stride;
  bool whole;
  bool loose;
  bool own;
  std::int32_t first;
  std::int32_t end;
};

/// A small triangle in the image, for its colours: the corners, each off by at
/// most `error` both ways, the reciprocals of their depths, off by at most
/// `weight_error` of themselves, and the depth of the first.
struct SmallTriangle {
  double x[3];
  double y[3];
  double weight[3];
  double first_depth;
  double error;
  double weight_error;
};

/// What shade_line() derives: levels are (n0 + n1 k) / (d0 + d k), k from the
/// pixel `first` on.
struct ShadedLine {
  float n0[3];
  float n1[3];
  float d0;
  float d;
  std::int32_t first;
  std::int32_t doubt;
};

}  // namespace halfspace::fast
