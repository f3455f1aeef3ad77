#include "raster/tile_buffer.hpp"

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

/// More memory than this is given back. Units: bytes.
constexpr std::size_t kMostSpare = std::size_t{1} << 25;

/// The memory of this thread's last buffer. Memory that is new for every frame
/// has pages that the system clears every time.
thread_local std::unique_ptr<TileMemory> spare;

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

std::size_t TileMemory::bytes() const {
  const auto room = [](const auto& r) {
    return static_cast<std::size_t>(r.count()) * sizeof(*r.get());
  };
  return lit.capacity() * sizeof(lit[0]) + open.capacity() * sizeof(open[0]) +
         mask_lists.capacity() * sizeof(mask_lists[0]) +
         leaf_of.capacity() * sizeof(leaf_of[0]) + room(before) +
         room(touched) + room(masks) + room(sources) + room(gradients) +
         sums.capacity() * sizeof(sums[0]);
}

TileBuffer::TileBuffer(const Rectangle& rectangle, PixelRange lines,
                       Rendering& result, bool with_leaves)
    : memory_(spare ? std::move(spare) : std::make_unique<TileMemory>()) {
  view_.columns = {rectangle.left, rectangle.right};
  view_.lines = lines;
  TileMemory& memory = *memory_;
  make_unlit(view_, memory, rectangle, lines);
  const std::size_t tiles = memory.lit.size() / kTileHeight;
  memory.mask_lists.assign(tiles, MaskList{});
  view_.mask_lists = memory.mask_lists.data();
  view_.masks = memory.masks.get();
  view_.mask_capacity = memory.masks.count();
  view_.sources = memory.sources.get();
  view_.source_capacity = memory.sources.count();
  view_.gradients = memory.gradients.get();
  view_.tile_items = memory.tile_items;
  view_.tile_colors = memory.tile_colors;
  view_.memory = &memory;
  view_.top = rectangle.top;
  view_.width = rectangle.right - rectangle.left;
  if (!result.items.pixels.empty()) {
    view_.items = result.items.pixels.data();
  }
  if (!result.colors.pixels.empty()) {
    static_assert(sizeof(Rgb) == 3);
    view_.colors = &result.colors.pixels[0].r;
  }
  if (!with_leaves) return;
  memory.leaf_of.assign(tiles, 0);
  memory.before.grow(static_cast<std::int32_t>(memory.lit.size()), 0);
  memory.touched.grow(static_cast<std::int32_t>(tiles), 0);
  view_.leaf_of = memory.leaf_of.data();
  view_.before = memory.before.get();
  view_.touched = memory.touched.get();
}

TileBuffer::~TileBuffer() {
  if (memory_->bytes() <= kMostSpare) spare = std::move(memory_);
}

void TileBuffer::add_up(std::int32_t samples) {
  const std::size_t tiles = memory_->lit.size() / kTileHeight;
  memory_->sums.assign(tiles * static_cast<std::size_t>(sums_per_tile(samples)),
                       0);
  view_.sums = memory_->sums.data();
  view_.samples = samples;
}

void grow_masks(MaskPool& pool) {
  auto& masks = pool.memory->masks;
  masks.grow(std::max(2 * pool.mask_capacity, 1024), pool.mask_capacity);
  pool.masks = masks.get();
  pool.mask_capacity = masks.count();
}

void grow_sources(MaskPool& pool) {
  TileMemory& memory = *pool.memory;
  const std::int32_t wanted = std::max(2 * pool.source_capacity, 1024);
  memory.gradients.grow(wanted, pool.source_capacity);
  memory.sources.grow(wanted, pool.source_capacity);
  pool.gradients = memory.gradients.get();
  pool.sources = memory.sources.get();
  pool.source_capacity = memory.sources.count();
}

void TileBuffer::enter_leaf() {
  view_.in_leaf = true;
  ++view_.leaf;
  view_.touched_count = 0;
  view_.most_masks = kMostMasks;
}

}  // namespace halfspace::fast
