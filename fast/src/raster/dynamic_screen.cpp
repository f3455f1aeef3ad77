#include <algorithm>
#include <bit>
#include <cstddef>

#include "halfspace/assert.hpp"
#include "halfspace/fast/screen.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "raster/tile_buffer.hpp"

namespace halfspace::fast {
namespace {

/// Calls visit(run) for every longest run of ones on a line, whose bits in the
/// tiles that the columns meet are word_of(tile).
template <class WordOf, class Visit>
void for_runs(PixelRange columns, WordOf&& word_of, Visit&& visit) {
  Span run = {0, -1};
  const std::int32_t last_tile = (columns.end - 1) / kTileWidth;
  for (std::int32_t tile = columns.first / kTileWidth; tile <= last_tile;
       ++tile) {
    const std::int32_t x = tile * kTileWidth;
    std::uint64_t bits = word_of(tile);
    while (bits != 0) {
      const int from = std::countr_zero(bits);
      const int count = std::countr_one(bits >> from);
      bits &= ~std::uint64_t{0} << (from + count);
      const Span next = {x + from, x + from + count - 1};
      if (run.last + 1 == next.first && run.first <= run.last) {
        run.last = next.last;
        continue;
      }
      if (run.first <= run.last) visit(run);
      run = next;
    }
  }
  if (run.first <= run.last) visit(run);
}

}  // namespace

struct DynamicScreen::Tiles {
  Tiles(std::int32_t width_px, std::int32_t height_px, SimdLevel simd)
      : width(width_px), height(height_px), kernel(best_kernel(simd)) {
    clear();
    now.resize(static_cast<std::size_t>(screen.tiles_across * kTileHeight));
  }

  void clear() {
    make_unlit(screen, memory, {0, 0, width, height}, {0, height});
  }

  /// The pixels of a segment that are on the screen.
  PixelRange columns_of(const ObjectSegment& object) const {
    if (object.line < 0 || object.line >= height) return {0, 0};
    const std::int32_t first = std::max(object.span.first, 0);
    const std::int32_t last = std::min(object.span.last, width - 1);
    return first <= last ? PixelRange{first, last + 1} : PixelRange{0, 0};
  }

  std::size_t light_row(std::span<const ObjectSegment> objects);

  std::int32_t width;
  std::int32_t height;
  const TileKernel& kernel;
  LitMemory memory;
  LitTiles screen;
  std::vector<std::uint32_t> now;  ///< what becomes lit of a tile row
  std::vector<ObjectSegment> lit;
};

/// Lights the first segments that lie on lines of one tile row, one below the
/// other. Gives how many those are.
std::size_t DynamicScreen::Tiles::light_row(
    std::span<const ObjectSegment> objects) {
  const std::int32_t row = objects[0].line / kTileHeight;
  alignas(32) std::uint32_t first[kTileHeight] = {};
  alignas(32) std::uint32_t end[kTileHeight] = {};
  PixelRange all = {width, 0};
  std::size_t count = 0;
  do {
    const PixelRange columns = columns_of(objects[count]);
    if (columns.first < columns.end) {
      const std::int32_t r = objects[count].line % kTileHeight;
      first[r] = static_cast<std::uint32_t>(columns.first);
      end[r] = static_cast<std::uint32_t>(columns.end);
      all = {std::min(all.first, columns.first),
             std::max(all.end, columns.end)};
    }
    ++count;
  } while (count < objects.size() &&
           objects[count].line > objects[count - 1].line &&
           objects[count].line / kTileHeight == row);
  if (all.first >= all.end) return count;
  const std::int32_t first_tile = all.first / kTileWidth;
  const std::int32_t last_tile = (all.end - 1) / kTileWidth;
  std::fill(now.begin() + first_tile * kTileHeight,
            now.begin() + (last_tile + 1) * kTileHeight, 0u);
  kernel.light(screen, row, first, end, now.data());
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t line = objects[k].line;
    const PixelRange columns = columns_of(objects[k]);
    if (columns.first >= columns.end) continue;
    const std::uint32_t* words = now.data() + line % kTileHeight;
    for_runs(
        columns, [&](std::int32_t tile) { return words[tile * kTileHeight]; },
        [&](Span run) {
          lit.push_back({line, run});
        });
  }
  return count;
}

DynamicScreen::DynamicScreen(std::int32_t width_px, std::int32_t height_px,
                             SimdLevel simd) {
  HALFSPACE_ASSERT(1 <= width_px && width_px <= 65536);
  HALFSPACE_ASSERT(1 <= height_px && height_px <= 65536);
  tiles_ = std::make_unique<Tiles>(width_px, height_px, simd);
}
DynamicScreen::DynamicScreen(DynamicScreen&&) noexcept = default;
DynamicScreen& DynamicScreen::operator=(DynamicScreen&&) noexcept = default;
DynamicScreen::~DynamicScreen() = default;

void DynamicScreen::clear() { tiles_->clear(); }

std::span<const ObjectSegment> DynamicScreen::light(
    std::span<const ObjectSegment> objects) {
  tiles_->lit.clear();
  while (!objects.empty()) {
    objects = objects.subspan(tiles_->light_row(objects));
  }
  return tiles_->lit;
}

std::vector<Span> DynamicScreen::unlit(std::int32_t line) const {
  std::vector<Span> spans;
  if (line < 0 || line >= tiles_->height) return spans;
  const LitTiles& screen = tiles_->screen;
  const std::uint32_t* lit =
      screen.lit + screen.tile_at(line / kTileHeight, 0) * kTileHeight +
      line % kTileHeight;
  for_runs(
      {0, tiles_->width},
      [&](std::int32_t tile) { return ~lit[tile * kTileHeight]; },
      [&](Span run) { spans.push_back(run); });
  return spans;
}

bool DynamicScreen::full() const { return tiles_->screen.open_tiles == 0; }

}  // namespace halfspace::fast
