#include "screen.hpp"

#include <algorithm>
#include <type_traits>
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

}  // namespace

Screen::Screen(const Rectangle& rectangle, PixelRange lines, Rendering& result,
               bool with_leaves) {
  canvas_.columns = {rectangle.left, rectangle.right};
  canvas_.lines = lines;
  canvas_.tiles_across = (rectangle.right + kTileWidth - 1) / kTileWidth;
  canvas_.words_across = (canvas_.tiles_across + 63) / 64;
  canvas_.first_row = lines.first / kTileHeight;
  light_outside(rectangle, lines);
  const std::size_t tiles = lit_.size() / kTileHeight;
  pieces_of_.resize(tiles);
  canvas_.lit = lit_.data();
  canvas_.open = open_.data();
  canvas_.pieces_of = pieces_of_.data();
  canvas_.tile_items = tile_items_;
  canvas_.tile_colors = tile_colors_;
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
  leaf_of_.resize(tiles);
  before_ = std::make_unique_for_overwrite<std::uint32_t[]>(lit_.size());
  touched_ = std::make_unique_for_overwrite<std::int32_t[]>(tiles);
  canvas_.leaf_of = leaf_of_.data();
  canvas_.before = before_.get();
  canvas_.touched = touched_.get();
}

/// Pixels that are not wanted count as lit.
void Screen::light_outside(const Rectangle& rectangle, PixelRange lines) {
  const std::int32_t rows =
      (lines.end + kTileHeight - 1) / kTileHeight - canvas_.first_row;
  const std::int32_t across = canvas_.tiles_across;
  lit_.resize(static_cast<std::size_t>(rows) *
              static_cast<std::size_t>(across * kTileHeight));
  open_.resize(static_cast<std::size_t>(rows * canvas_.words_across));
  const std::int32_t first_tile = rectangle.left / kTileWidth;
  for (std::int32_t row = 0; row < rows; ++row) {
    const std::int32_t top = (canvas_.first_row + row) * kTileHeight;
    const bool whole_lines =
        top >= lines.first && top + kTileHeight <= lines.end;
    std::uint32_t* lit = lit_.data() + std::int64_t{row} * across * kTileHeight;
    std::uint64_t* open =
        open_.data() + std::int64_t{row} * canvas_.words_across;
    for (std::int32_t tile = 0; tile < across; ++tile) {
      const std::int32_t x = tile * kTileWidth;
      if (tile >= first_tile) {
        open[tile / 64] |= std::uint64_t{1} << (tile % 64);
        ++canvas_.open_tiles;
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

void Screen::make_room(Room what) {
  const auto grow = [](auto& values, std::int32_t& room, std::int32_t wanted) {
    using T = std::remove_reference_t<decltype(values[0])>;
    auto memory =
        std::make_unique_for_overwrite<T[]>(static_cast<std::size_t>(wanted));
    std::copy_n(values.get(), room, memory.get());
    values = std::move(memory);
    room = wanted;
    return values.get();
  };
  const auto more = [](std::int32_t room) { return std::max(2 * room, 1024); };
  switch (what) {
    case Room::kPieces:
      canvas_.pieces =
          grow(pieces_, canvas_.piece_room, more(canvas_.piece_room));
      break;
    case Room::kInks:
      canvas_.inks = grow(inks_, canvas_.ink_room, more(canvas_.ink_room));
      break;
    case Room::kGradients:
      canvas_.gradients =
          grow(gradients_, canvas_.gradient_room, canvas_.ink_room);
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
