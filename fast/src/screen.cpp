#include "screen.hpp"

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
  const std::int32_t rows =
      (lines.end + kTileHeight - 1) / kTileHeight - canvas_.first_row;
  const auto tiles = static_cast<std::size_t>(rows) *
                     static_cast<std::size_t>(canvas_.tiles_across);
  lit_.resize(tiles * kTileHeight);
  open_.resize(static_cast<std::size_t>(rows) *
               static_cast<std::size_t>(canvas_.words_across));
  if (with_leaves) {
    leaf_of_.resize(tiles);
    before_.resize(tiles * kTileHeight);
    full_.resize(tiles);
  }
  // Pixels that are not wanted count as lit.
  std::size_t index = 0;
  for (std::int32_t row = 0; row < rows; ++row) {
    for (std::int32_t tile = 0; tile < canvas_.tiles_across; ++tile, ++index) {
      bool some = false;
      for (std::int32_t r = 0; r < kTileHeight; ++r) {
        const std::int32_t j = (canvas_.first_row + row) * kTileHeight + r;
        const std::uint32_t unlit =
            j < lines.first || j >= lines.end
                ? 0
                : bits_between(rectangle.left, rectangle.right,
                               tile * kTileWidth);
        lit_[index * kTileHeight + static_cast<std::size_t>(r)] = ~unlit;
        some = some || unlit != 0;
      }
      if (!some) continue;
      open_[static_cast<std::size_t>(row * canvas_.words_across + tile / 64)] |=
          std::uint64_t{1} << (tile % 64);
      ++canvas_.open_tiles;
    }
  }
  canvas_.lit = lit_.data();
  canvas_.open = open_.data();
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
  canvas_.leaf_of = leaf_of_.data();
  canvas_.before = before_.data();
  canvas_.full = full_.data();
  if (canvas_.items == nullptr) {
    slot_of_.resize(tiles);
    canvas_.slot_of = slot_of_.data();
    // Leaves that cover all are rare: what is not used is not touched either.
    slots_ = std::make_unique_for_overwrite<std::int32_t[]>(tiles * kTileWidth *
                                                            kTileHeight);
    canvas_.slots = slots_.get();
  }
}

void Screen::enter_leaf() {
  canvas_.in_leaf = true;
  ++canvas_.leaf;
  canvas_.full_count = 0;
  canvas_.slot_count = 0;
}

void Screen::leave_leaf() {
  canvas_.in_leaf = false;
  for (std::int32_t k = 0; k < canvas_.full_count; ++k) {
    const std::int32_t tile = full_[static_cast<std::size_t>(k)];
    const std::int32_t row = canvas_.first_row + tile / canvas_.tiles_across;
    const std::int32_t column = tile % canvas_.tiles_across;
    std::uint64_t& word = canvas_.open[canvas_.open_at(row) + column / 64];
    const std::uint64_t bit = std::uint64_t{1} << (column % 64);
    if ((word & bit) != 0) --canvas_.open_tiles;
    word &= ~bit;
  }
}

}  // namespace halfspace::fast
