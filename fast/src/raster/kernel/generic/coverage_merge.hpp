#pragma once

#include <cstdint>

#include "raster/kernel/generic/tile_write.hpp"

namespace halfspace::fast {

/// Merges what polygons cover with what is lit, tile by tile.
template <class Simd>
struct CoverageMerge : TileWrite<Simd> {
  using Simd::all, Simd::and_not, Simd::any, Simd::columns_between;
  using Simd::columns_in_all, Simd::cover_of, Simd::every, Simd::fill_colors;
  using Simd::fill_items, Simd::flat_color, Simd::load, Simd::none, Simd::store;
  using typename Simd::FlatColor, typename Simd::Words8;
  using Write = TileWrite<Simd>;
  using Write::keep_mask, Write::nearer_of, Write::paint, Write::paint_over;
  using Write::write_tile;

  static void close_tile(LitTiles& screen, std::int32_t row,
                         std::int32_t tile) {
    screen.open[screen.open_at(row) + tile / 64] &=
        ~(std::uint64_t{1} << (tile % 64));
    --screen.open_tiles;
  }

  /// F2B's Merge for the 256 pixels of a tile (S4.8): the unlit pixels of
  /// `cover` become lit, the other unlit pixels stay so.
  struct MergedTile {
    Words8 lit;  ///< what becomes lit
    Words8 now;  ///< all that is lit from now on
  };
  static MergedTile merged(Words8 was, Words8 cover) {
    const Words8 lit = and_not(cover, was);
    return {lit, was | lit};
  }

  /// Merges `cover` into a tile, and closes it if that fills it.
  struct LitTile {
    Words8 lit;
    bool fills;
  };
  static LitTile light_tile(LitTiles& screen, std::int32_t row,
                            std::int32_t tile, Words8 cover) {
    std::uint32_t* words = screen.lit + screen.tile_at(row, tile) * kTileHeight;
    const auto [lit, now] = merged(load(words), cover);
    if (!any(lit)) return {lit, false};
    ++screen.touches;
    store(words, now);
    const bool fills = all(now);
    if (fills) close_tile(screen, row, tile);
    return {lit, fills};
  }

  /// Lights all of `count` tiles.
  static void light_tiles(LitTiles& screen, std::int32_t row, std::int32_t tile,
                          std::int32_t count) {
    std::uint32_t* words = screen.lit + screen.tile_at(row, tile) * kTileHeight;
    screen.touches += count;
    for (std::int32_t k = 0; k < count; ++k) {
      store(words + k * kTileHeight, every());
      close_tile(screen, row, tile + k);
    }
  }

  static std::int64_t count_of(Words8 pixels) {
    alignas(32) std::uint32_t bits[kTileHeight];
    store(bits, pixels);
    std::int64_t count = 0;
    for (std::int32_t r = 0; r < kTileHeight; ++r) {
      count += __builtin_popcount(bits[r]);
    }
    return count;
  }

  /// The pixels of `cover` that this leaf has lit before.
  static Words8 contested_of(const TileView& screen, std::int64_t index,
                             Words8 cover, Words8 was) {
    if (!screen.in_leaf || screen.leaf_of[index] != screen.leaf) return none();
    return and_not(cover & was, load(screen.before + index * kTileHeight));
  }

  /// Lights what `cover` covers of one tile within a leaf. Gives what is to be
  /// painted: that, and where the polygon is nearer than what the leaf has lit
  /// before.
  static Words8 light_in_leaf(TileView& screen, std::int32_t row,
                              std::int32_t tile, Words8 cover) {
    const std::int64_t index = screen.tile_at(row, tile);
    std::uint32_t* lit = screen.lit + index * kTileHeight;
    const Words8 was = load(lit);
    auto [painted, now] = merged(was, cover);
    const Words8 contested = contested_of(screen, index, cover, was);
    if (any(contested)) {
      painted = painted | nearer_of(screen, index, tile * kTileWidth,
                                    row * kTileHeight, contested);
    }
    if (!any(painted)) return painted;
    ++screen.touches;
    if (screen.leaf_of[index] != screen.leaf) {
      screen.leaf_of[index] = screen.leaf;
      store(screen.before + index * kTileHeight, was);
      screen.touched[screen.touched_count++] = static_cast<std::int32_t>(index);
    }
    store(lit, now);
    return painted;
  }

  /// The same, and keeps what is to be painted.
  static void merge_in_leaf(TileView& screen, std::int32_t row,
                            std::int32_t tile, Words8 cover,
                            const PixelSource& source) {
    const Words8 painted = light_in_leaf(screen, row, tile, cover);
    if (!any(painted)) return;
    keep_mask(screen, screen.tile_at(row, tile), painted, source);
  }

  /// Lights and paints what `cover` covers of one tile, not in a leaf.
  static void merge_ordered(TileView& screen, std::int32_t row,
                            std::int32_t tile, Words8 cover,
                            const PixelSource& source) {
    const auto [painted, fills] = light_tile(screen, row, tile, cover);
    if (!any(painted)) return;
    const std::int64_t index = screen.tile_at(row, tile);
    if (fills || screen.mask_lists[index].count + 1 >= kMostMasks) {
      write_tile(screen, index, tile * kTileWidth, row * kTileHeight, painted,
                 &source);
    } else {
      keep_mask(screen, index, painted, source);
    }
  }

  /// How many of the tiles from `tile` on, up to `end`, are open, by their
  /// bits, and not lit at all.
  static std::int32_t blank_from(const LitTiles& screen, std::int32_t row,
                                 std::int32_t tile, std::int32_t end,
                                 std::uint64_t open) {
    const std::uint32_t* lit =
        screen.lit + screen.tile_at(row, tile) * kTileHeight;
    std::int32_t count = 0;
    while (tile + count < end && (open & 1u) != 0 && !any(load(lit))) {
      ++count;
      open >>= 1;
      lit += kTileHeight;
    }
    return count;
  }

  /// Merges the pixels from `firsts` up to `ends` of the 8 lines of a tile row,
  /// tile by tile where a tile is open: those that are blank and covered all
  /// over are lit and go to sink.fill(tile, count), if sink.fills(), the others
  /// to sink.merge(tile, cover).
  template <class Sink>
  static void merge_row(LitTiles& screen, std::int32_t row, Words8 firsts,
                        Words8 ends, Sink& sink) {
    const PixelRange columns = columns_between(firsts, ends);
    if (columns.first >= columns.end) return;
    const std::int32_t first_tile = columns.first / kTileWidth;
    const std::int32_t last_tile = (columns.end - 1) / kTileWidth;
    // Tiles that are covered all over.
    PixelRange full = {0, 0};
    if (sink.fills()) {
      full = columns_in_all(firsts, ends);
      full = {(full.first + kTileWidth - 1) / kTileWidth,
              full.end / kTileWidth};
    }
    const std::uint64_t* open = screen.open + screen.open_at(row);
    for (std::int32_t w = first_tile / 64; w <= last_tile / 64; ++w) {
      std::uint64_t tiles = open[w];
      if (w == first_tile / 64) tiles &= ~std::uint64_t{0} << (first_tile % 64);
      if (w == last_tile / 64) {
        tiles &= ~std::uint64_t{0} >> (63 - last_tile % 64);
      }
      while (tiles != 0) {
        const std::int32_t place = __builtin_ctzll(tiles);
        const std::int32_t tile = w * 64 + place;
        if (tile >= full.first && tile < full.end) {
          const std::int32_t blank =
              blank_from(screen, row, tile, full.end, tiles >> place);
          if (blank > 0) {
            light_tiles(screen, row, tile, blank);
            sink.fill(tile, blank);
            tiles &= ~((~std::uint64_t{0} >> (64 - blank)) << place);
            continue;
          }
        }
        tiles &= tiles - 1;
        sink.merge(tile, cover_of(firsts, ends, tile * kTileWidth));
      }
    }
  }

  /// Writes what becomes lit, 8 words a tile.
  struct LitWords {
    LitTiles& screen;
    std::int32_t row;
    std::uint32_t* now;

    static bool fills() { return true; }
    void fill(std::int32_t tile, std::int32_t count) const {
      for (std::int32_t k = tile; k < tile + count; ++k) {
        store(now + k * kTileHeight, every());
      }
    }
    void merge(std::int32_t tile, Words8 cover) const {
      store(now + tile * kTileHeight, light_tile(screen, row, tile, cover).lit);
    }
  };

  static void light(LitTiles& screen, std::int32_t row,
                    const std::uint32_t* first, const std::uint32_t* end,
                    std::uint32_t* now) {
    const LitWords words = {screen, row, now};
    merge_row(screen, row, load(first), load(end), words);
  }

  /// Paints `count` tiles, all of each.
  static void paint_tiles(const TileView& screen, std::int32_t row,
                          std::int32_t tile, std::int32_t count,
                          const PixelSource& source) {
    const std::int32_t x = tile * kTileWidth;
    const std::int32_t y = row * kTileHeight;
    if (source.smooth() || Write::adds_up(screen)) {
      for (std::int32_t k = 0; k < count; ++k) {
        paint(screen, x + k * kTileWidth, y, every(), source);
      }
      return;
    }
    const FlatColor color = flat_color(source.color);
    std::int64_t at = screen.pixel_at(x, y);
    for (std::int32_t r = 0; r < kTileHeight; ++r, at += screen.width) {
      if (screen.items != nullptr)
        fill_items(screen.items + at, count, source.id);
      if (screen.colors != nullptr) {
        fill_colors(screen.colors + 3 * at, count, color);
      }
    }
  }

  /// Paints what a polygon lights, or all that it covers if screen.overwrite;
  /// then counts that.
  struct Painter {
    TileView& screen;
    std::int32_t row;
    const PixelSource& source;

    std::int64_t count = 0;

    bool fills() const { return !screen.overwrite && !screen.in_leaf; }
    void fill(std::int32_t tile, std::int32_t tiles) const {
      paint_tiles(screen, row, tile, tiles, source);
    }
    void merge(std::int32_t tile, Words8 cover) {
      if (screen.overwrite) {
        paint_over(screen, tile * kTileWidth, row * kTileHeight, cover, source);
        count += count_of(cover);
        ++screen.touches;
      } else if (screen.in_leaf) {
        merge_in_leaf(screen, row, tile, cover, source);
      } else {
        merge_ordered(screen, row, tile, cover, source);
      }
    }
  };

  /// Merges the pixels from `firsts` up to `ends` of the 8 lines of a tile row.
  /// Returns how many pixels that was if screen.overwrite, else 0.
  static std::int64_t draw_spans(TileView& screen, std::int32_t row,
                                 Words8 firsts, Words8 ends,
                                 const PixelSource& source) {
    Painter painter = {screen, row, source};
    merge_row(screen, row, firsts, ends, painter);
    return painter.count;
  }
};

}  // namespace halfspace::fast
