#include "raster/screen.hpp"

#include <algorithm>
#include <utility>

namespace halfspace::fast {
namespace {

/// The bits from `first` up to `end` of the 32 from `x` on.
std::uint32_t bits_between(std::int32_t first, std::int32_t end,
                           std::int32_t x) {
  const auto from = [x](std::int32_t column) -> std::uint32_t {
    if (column - x >= kTileWidth) return 0;
    return ~std::uint32_t{0} << (column > x ? column - x : 0);
  };
  return from(first) & ~from(end);
}

/// More than this is given back. Units: bytes.
constexpr std::size_t kMostSpare = std::size_t{1} << 25;

/// What the last screen of this thread used: asked for anew for every frame,
/// the system would clear its pages every time.
thread_local std::unique_ptr<ScreenMemory> spare;

}  // namespace

void make_unlit(LitTiles& screen, LitMemory& memory, const Rectangle& rectangle,
                PixelRange lines) {
  screen.tiles_across = (rectangle.right + kTileWidth - 1) / kTileWidth;
  screen.words_across = (screen.tiles_across + 63) / 64;
  screen.first_row = lines.first / kTileHeight;
  screen.open_tiles = 0;
  const std::int32_t rows =
      (lines.end + kTileHeight - 1) / kTileHeight - screen.first_row;
  const std::int32_t across = screen.tiles_across;
  memory.lit.assign(static_cast<std::size_t>(rows) *
                        static_cast<std::size_t>(across * kTileHeight),
                    0);
  memory.open.assign(static_cast<std::size_t>(rows * screen.words_across), 0);
  screen.lit = memory.lit.data();
  screen.open = memory.open.data();
  const std::int32_t first_tile = rectangle.left / kTileWidth;
  for (std::int32_t row = 0; row < rows; ++row) {
    const std::int32_t top = (screen.first_row + row) * kTileHeight;
    const bool whole_lines =
        top >= lines.first && top + kTileHeight <= lines.end;
    std::uint32_t* lit = screen.lit + std::int64_t{row} * across * kTileHeight;
    std::uint64_t* open = screen.open + std::int64_t{row} * screen.words_across;
    for (std::int32_t tile = 0; tile < across; ++tile) {
      const std::int32_t x = tile * kTileWidth;
      if (tile >= first_tile) {
        open[tile / 64] |= std::uint64_t{1} << (tile % 64);
        ++screen.open_tiles;
        if (whole_lines && x >= rectangle.left &&
            x + kTileWidth <= rectangle.right) {
          continue;
        }
      }
      for (std::int32_t r = 0; r < kTileHeight; ++r) {
        const std::int32_t j = top + r;
        lit[tile * kTileHeight + r] =
            j < lines.first || j >= lines.end
                ? ~std::uint32_t{0}
                : ~bits_between(rectangle.left, rectangle.right, x);
      }
    }
  }
}

std::size_t ScreenMemory::bytes() const {
  const auto room = [](const auto& r) {
    return static_cast<std::size_t>(r.count()) * sizeof(*r.get());
  };
  return lit.capacity() * sizeof(lit[0]) + open.capacity() * sizeof(open[0]) +
         pieces_of.capacity() * sizeof(pieces_of[0]) +
         leaf_of.capacity() * sizeof(leaf_of[0]) + room(before) +
         room(touched) + room(pieces) + room(inks) + room(gradients);
}

Screen::Screen(const Rectangle& rectangle, PixelRange lines, Rendering& result,
               bool with_leaves)
    : memory_(spare ? std::move(spare) : std::make_unique<ScreenMemory>()) {
  canvas_.columns = {rectangle.left, rectangle.right};
  canvas_.lines = lines;
  ScreenMemory& memory = *memory_;
  make_unlit(canvas_, memory, rectangle, lines);
  const std::size_t tiles = memory.lit.size() / kTileHeight;
  memory.pieces_of.assign(tiles, Pieces{});
  canvas_.pieces_of = memory.pieces_of.data();
  canvas_.pieces = memory.pieces.get();
  canvas_.piece_room = memory.pieces.count();
  canvas_.inks = memory.inks.get();
  canvas_.ink_room = memory.inks.count();
  canvas_.gradients = memory.gradients.get();
  canvas_.tile_items = memory.tile_items;
  canvas_.tile_colors = memory.tile_colors;
  canvas_.owner = this;
  canvas_.make_room = [](Canvas& canvas, Room what) {
    static_cast<Screen*>(canvas.owner)->make_room(what);
  };
  canvas_.top = rectangle.top;
  canvas_.width = rectangle.right - rectangle.left;
  if (!result.items.pixels.empty()) {
    canvas_.items = result.items.pixels.data();
  }
  if (!result.colors.pixels.empty()) {
    static_assert(sizeof(Rgb) == 3);
    canvas_.colors = &result.colors.pixels[0].r;
  }
  if (!with_leaves) return;
  memory.leaf_of.assign(tiles, 0);
  memory.before.grow(static_cast<std::int32_t>(memory.lit.size()), 0);
  memory.touched.grow(static_cast<std::int32_t>(tiles), 0);
  canvas_.leaf_of = memory.leaf_of.data();
  canvas_.before = memory.before.get();
  canvas_.touched = memory.touched.get();
}

Screen::~Screen() {
  if (memory_->bytes() <= kMostSpare) spare = std::move(memory_);
}

void Screen::make_room(Room what) {
  const auto grow = [](auto& room, std::int32_t& count, std::int32_t wanted) {
    room.grow(wanted, count);
    count = room.count();
    return room.get();
  };
  const auto more = [](std::int32_t room) { return std::max(2 * room, 1024); };
  switch (what) {
    case Room::kPieces:
      canvas_.pieces =
          grow(memory_->pieces, canvas_.piece_room, more(canvas_.piece_room));
      break;
    case Room::kInks:
      memory_->gradients.grow(more(canvas_.ink_room), canvas_.ink_room);
      canvas_.gradients = memory_->gradients.get();
      canvas_.inks =
          grow(memory_->inks, canvas_.ink_room, more(canvas_.ink_room));
      break;
  }
}

void Screen::enter_leaf() {
  canvas_.in_leaf = true;
  ++canvas_.leaf;
  canvas_.touched_count = 0;
  canvas_.most_pieces = kMostPieces;
}

}  // namespace halfspace::fast
