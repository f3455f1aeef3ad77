#pragma once

#include <cstdint>

#include "camera/edge_function.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/simd.hpp"

namespace halfspace::fast {

struct View;

/// A tile is 32 x 8 pixels: one word a line, least bit leftmost, 256 bits.
constexpr std::int32_t kTileWidth = 32;
constexpr std::int32_t kTileHeight = 8;

/// What is written where a polygon lights a pixel.
///
/// Whole words: bytes that are written one by one are slow to read together.
struct Ink {
  std::int32_t id = 0;
  std::uint32_t color = 0;    ///< packed_color(), or kSmooth
  std::int32_t eye_sign = 0;  ///< the side of it that the eye is on
  std::int32_t uses = 0;      ///< pieces that have it, or the next spare ink

  /// Decider::gradient() tells the colours.
  static constexpr std::uint32_t kSmooth = ~std::uint32_t{0};
  bool smooth() const { return color == kSmooth; }
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

/// No piece, no ink.
constexpr std::int32_t kNone = -1;
/// What a polygon has lit of a tile, kept until its colours are written or,
/// where they are already, until the leaf that it is of ends.
struct LitPiece {
  std::uint32_t lit[8];
  std::int32_t id = 0;       ///< the polygon
  std::uint32_t color = 0;   ///< as of an ink, or kWritten
  std::int32_t ink = kNone;  ///< where it is kept, if it is smooth
  std::int32_t next = 0;     ///< lit before it, of the same tile

  static constexpr std::uint32_t kWritten = Ink::kSmooth - 1;
  bool is_written() const { return color == kWritten; }
};
/// From so many pieces on a tile is written though it is open.
constexpr std::int32_t kMostPieces = 8;
/// The pieces of a tile: those that were lit last and first, how many there
/// are, how many of them are written, and how many have inks that are kept.
struct Pieces {
  std::int32_t newest = kNone;
  std::int32_t oldest = kNone;
  std::int32_t count = 0;
  std::int32_t written = 0;
  std::int32_t with_ink = 0;
};
/// What memory may run out of.
enum class Room : std::uint8_t { kPieces, kInks };

/// Which pixels are lit: the dynamic screen (S4.8), by tiles. What is off the
/// screen is lit.
struct LitTiles {
  std::int32_t first_row = 0;  ///< the tile row at which tiles are counted
  std::int32_t tiles_across = 0;
  std::int32_t words_across = 0;  ///< of `open`, a tile row
  std::uint32_t* lit = nullptr;   ///< 8 words a tile, tile by tile
  std::uint64_t* open = nullptr;  ///< one bit a tile: some pixel is unlit
  std::int64_t open_tiles = 0;    ///< how many of those bits are set

  std::int64_t tile_at(std::int32_t row, std::int32_t tile) const {
    return std::int64_t{row - first_row} * tiles_across + tile;
  }
  std::int64_t open_at(std::int32_t row) const {
    return std::int64_t{row - first_row} * words_across;
  }
};

/// The screen that one thread fills: which pixels are lit, and the images.
///
/// Front to back a tile keeps a list of what was lit in it, and is written when
/// all of it is lit, or the list is long: the images are hardly read back, and
/// mostly written 32 pixels at a time.
///
/// Plain pointers, so that the inner loops can be compiled for several
/// instruction sets and share nothing else. Units: pixels, tiles.
struct Canvas : LitTiles {
  PixelRange columns;              ///< the columns asked for: of the images
  PixelRange lines;                ///< the lines of this thread
  std::int32_t top = 0;            ///< the line at which the images begin
  std::int32_t* items = nullptr;   ///< null: not wanted
  std::uint8_t* colors = nullptr;  ///< null: not wanted
  std::int64_t width = 0;          ///< of the images

  bool overwrite = false;  ///< back to front: paint the lit pixels at once

  Pieces* pieces_of = nullptr;  ///< a tile's
  LitPiece* pieces = nullptr;
  std::int32_t piece_count = 0;      ///< so many have been used
  std::int32_t piece_room = 0;       ///< for so many there is memory
  std::int32_t spare_piece = kNone;  ///< pieces that may be used again
  /// The inks of pieces that are smooth, and their gradients.
  Ink* inks = nullptr;
  Gradient* gradients = nullptr;
  std::int32_t ink_count = 0;
  std::int32_t ink_room = 0;
  std::int32_t spare_ink = kNone;
  std::int32_t ink_at_hand = kNone;  ///< of the polygon being drawn, if kept
  std::int32_t last_ink = kNone;     ///< the last that was kept
  /// Makes room for one more.
  void (*make_room)(Canvas& canvas, Room what) = nullptr;
  void* owner = nullptr;
  /// Where a tile is put together, line by line.
  std::int32_t* tile_items = nullptr;
  std::uint8_t* tile_colors = nullptr;

  /// Within a leaf, whose fragments hide each other in any order: the pixels
  /// that were lit when it began, kept for the tiles it has touched.
  bool in_leaf = false;
  std::uint32_t leaf = 0;            ///< its number
  std::uint32_t* leaf_of = nullptr;  ///< the leaf that touched the tile last
  std::uint32_t* before = nullptr;   ///< lit, when that leaf touched it first
  std::int32_t* touched = nullptr;   ///< tiles that the leaf has touched
  std::int32_t touched_count = 0;
  /// How many tiles the last leaves touched, and the pieces there, each leaf
  /// counting a little less than the next.
  float recent_tiles = 0;
  float recent_pieces = 0;
  /// So many pieces on one of them are written when the leaf ends. 1 where its
  /// polygons are small: there are many inks, which need not be kept.
  std::int32_t most_pieces = kMostPieces;

  /// Where a pixel is in the images.
  std::int64_t pixel_at(std::int32_t x, std::int32_t y) const {
    return (y - top) * width + (x - columns.first);
  }
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

/// What became of the fragments of a block.
struct BlockDrawn {
  std::int32_t displayed = 0;  ///< how many were displayed, seen or not
  std::uint32_t left = 0;      ///< the bits of those that need more than this
};

/// What the loops ask back where doubles cannot tell.
struct Decider {
  /// Of a block's fragments the k-th is meant from now on, and turns as an
  /// Outline does.
  Ink (*begin)(void* context, std::int32_t k, std::int32_t turn);
  /// The pixels of line `j` whose samples the polygon covers, of `range`.
  PixelRange (*exact_line)(void* context, std::int32_t j, PixelRange range);
  /// Of the pixels `lit` (8 words) of the tile with the left top pixel (x, y),
  /// which show polygon `other`, those where this polygon is nearer: left in
  /// `lit`.
  void (*nearer)(void* context, std::int32_t other, std::int32_t x,
                 std::int32_t y, std::uint32_t* lit);
  /// The polygon's colours, where they are smooth.
  const Gradient& (*gradient)(void* context);
  /// Colours the pixels `bits` of line y from column x on one by one, in the
  /// ink's colours; column x is at byte `at`.
  void (*shade)(void* context, const Ink& ink, std::int32_t x, std::int32_t y,
                std::uint32_t bits, std::uint8_t* colors, std::int64_t at);
  /// Lays the polygon over what the pixels `bits` (8 words) of a tile show;
  /// null: nothing is seen through it.
  void (*blend)(void* context, std::int32_t x, std::int32_t y,
                const std::uint32_t* bits);
  void* context;
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
enum class Sight : std::uint8_t { kHidden, kShown, kUntold };

/// The inner loops for one instruction set.
struct Kernel {
  /// Lights the pixels from first[r] up to end[r] of the 8 lines r of a tile
  /// row that are on the screen. `now`, 8 words for each tile of the row, gets
  /// what becomes lit; tiles where nothing does are left as they are.
  void (*light)(LitTiles& screen, std::int32_t row, const std::uint32_t* first,
                const std::uint32_t* end, std::uint32_t* now);
  /// Lights and paints what the outline covers of the unlit pixels. Returns
  /// how many pixels that was if canvas.overwrite, else 0.
  std::int64_t (*draw)(Canvas& canvas, const Outline& outline, const Ink& ink,
                       const Decider& decider);
  /// The same for an outline that is known only line by line, exactly.
  std::int64_t (*draw_lines)(Canvas& canvas, PixelRange lines, const Ink& ink,
                             const Decider& decider);
  /// The same for the fragments of a block of a leaf, seen in the view, `cull`
  /// leaving out those that the eye is on the negative side of.
  BlockDrawn (*draw_triangles)(Canvas& canvas, const View& view, bool cull,
                               const FragmentBlock<3>& block,
                               const Decider& decider);
  BlockDrawn (*draw_quadrangles)(Canvas& canvas, const View& view, bool cull,
                                 const FragmentBlock<4>& block,
                                 const Decider& decider);
  /// Whether a tile that meets the rectangle is open.
  bool (*any_open)(const Canvas& canvas, PixelRange columns, PixelRange lines);
  /// Out of leaves: whether a pixel of the rectangle is unlit.
  bool (*any_unlit)(const Canvas& canvas, PixelRange columns, PixelRange lines);
  /// Out of leaves: whether something in the box can light a pixel.
  Sight (*see_box)(const Canvas& canvas, const BoxView& view, const Box& box);
  /// Ends a leaf: closes tiles that it has filled.
  void (*leave_leaf)(Canvas& canvas, const Decider& decider);
  /// Paints every unlit pixel, and writes what is not written yet. Returns how
  /// many there were.
  std::int64_t (*fill_rest)(Canvas& canvas, const Ink& ink,
                            const Decider& decider);
};

extern const Kernel kPlainKernel;  ///< runs everywhere
#if defined(__x86_64__)
extern const Kernel kAvx2Kernel;    ///< needs AVX2
extern const Kernel kAvx512Kernel;  ///< needs AVX-512 with VBMI, and BMI2
#endif

/// The kernel of the level, or the best below it that this processor has.
const Kernel& best_kernel(SimdLevel level = SimdLevel::kBest);

}  // namespace halfspace::fast
