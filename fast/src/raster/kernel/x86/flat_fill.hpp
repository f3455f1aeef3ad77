#pragma once

#include <immintrin.h>

#include <cstdint>

#include "raster/kernel/tile_view.hpp"
#include "raster/kernel/x86/color_sums.hpp"

namespace halfspace::fast {
namespace {

/// Tiles of flat colours.
struct FlatFill : ColorSums {
  /// Writes a colour into pixels of a tile.
  static void put_runs(const TileView& screen, std::int32_t x, std::int32_t y,
                       Words8 pixels, std::uint32_t packed) {
    alignas(32) std::uint32_t bits[kTileHeight];
    store(bits, pixels);
    const FlatColor color = flat_color(packed);
    for (std::uint32_t rows = some_of(pixels); rows != 0; rows &= rows - 1) {
      const std::int32_t r = __builtin_ctz(rows);
      store_runs(screen.colors + 3 * screen.pixel_at(x, y + r), bits[r], color);
    }
  }

  /// Writes the colours of a tile at (x, y), which are flat, mask by mask, each
  /// pixel once, if stores under a mask need not read the image; false: nothing
  /// is done.
  static bool write_parts(const TileView& screen, const MaskList& masks,
                          std::int32_t x, std::int32_t y, Words8 at_hand,
                          const PixelSource* source) {
    if (!kMaskedStores) return false;
    Words8 rest = every();
    if (source != nullptr) {
      put_runs(screen, x, y, at_hand, source->color);
      rest = and_not(rest, at_hand);
    }
    std::int32_t place = masks.newest;
    for (; place != kNone; place = screen.masks[place].next) {
      const CoverageMask& mask = screen.masks[place];
      const Words8 pixels = load(mask.lit);
      if (!mask.is_written()) {
        put_runs(screen, x, y, pixels & rest, mask.color);
      }
      rest = and_not(rest, pixels);
    }
    return true;
  }

  /// The pixels of a tile that one colour has.
  struct FlatPart {
    alignas(32) std::uint32_t bits[kTileHeight];
    FlatColor color;
  };

  /// More parts than this are put together part by part. Without this path flat
  /// frames of large triangles take 4 to 5 % more instructions.
  static constexpr int kMostFlatParts = 6;

  /// The parts of a tile: what is `at_hand`, if any, and its masks; what was
  /// lit later hides the earlier. Gives how many there are, at most
  /// kMostFlatParts, or 0 where they leave pixels out.
  static int collect_flat_parts(const TileView& screen, std::int32_t place,
                                Words8 at_hand, const PixelSource* source,
                                FlatPart* parts) {
    int count = 0;
    Words8 rest = every();
    const auto enter = [&](Words8 pixels, std::uint32_t color) {
      pixels = pixels & rest;
      rest = and_not(rest, pixels);
      store(parts[count].bits, pixels);
      parts[count].color = flat_color(color);
      ++count;
    };
    if (source != nullptr) enter(at_hand, source->color);
    for (; place != kNone; place = screen.masks[place].next) {
      const CoverageMask& mask = screen.masks[place];
      enter(load(mask.lit), mask.color);
    }
    return any(rest) ? 0 : count;
  }

  /// Writes the colours of a whole tile at (x, y), which are flat, if they are
  /// few; false: nothing is done.
  static bool write_few(const TileView& screen, const MaskList& masks,
                        std::int32_t x, std::int32_t y, Words8 at_hand,
                        const PixelSource* source) {
    if (masks.count + (source != nullptr ? 1 : 0) > kMostFlatParts)
      return false;
    FlatPart parts[kMostFlatParts];
    const int count =
        collect_flat_parts(screen, masks.newest, at_hand, source, parts);
    if (count == 0) return false;
    std::uint8_t* to = screen.colors + 3 * screen.pixel_at(x, y);
    const FlatColor& below = parts[count - 1].color;
    for (int r = 0; r < kTileHeight; ++r, to += 3 * screen.width) {
      ColorLine line = line_of(below);
      for (int p = 0; p < count - 1; ++p) {
        lay(line, parts[p].bits[r], parts[p].color);
      }
      store(to, line);
    }
    return true;
  }

  /// Writes the colours of a tile at (x, y) if they are flat, and few where
  /// that matters; false: all is still to be written. `whole`: all of the tile
  /// is there, and nothing of it is written.
  static bool write_flat(const TileView& screen, const MaskList& masks,
                         bool whole, std::int32_t x, std::int32_t y,
                         Words8 at_hand, const PixelSource* source) {
    if (masks.with_source > 0 || (source != nullptr && source->smooth()))
      return false;
    return (whole && write_few(screen, masks, x, y, at_hand, source)) ||
           write_parts(screen, masks, x, y, at_hand, source);
  }
};

}  // namespace
}  // namespace halfspace::fast
