#pragma once

#include <cstdint>

#include "raster/kernel/generic/shade.hpp"

namespace halfspace::fast {

/// Writes to the images, and keeps masks until then.
template <class Simd>
struct TileWrite : Shade<Simd> {
  using Simd::all, Simd::and_not, Simd::any, Simd::copy_colors;
  using Simd::copy_items, Simd::copy_some_colors, Simd::copy_some_items;
  using Simd::every, Simd::flat_color, Simd::load, Simd::none, Simd::some_of;
  using Simd::store, Simd::store_colors, Simd::store_items, Simd::write_flat;
  using typename Simd::FlatColor, typename Simd::Words8;
  /// Whether colours of samples are added up.
  static bool adds_up(const TileView& screen) {
    return Simd::kAddsUp && screen.sums != nullptr;
  }

  using Shade<Simd>::put_smooth;

  /// The colours of a tile in the image.
  static Target target_of(const TileView& screen, std::int32_t x,
                          std::int32_t y) {
    const std::int32_t first = scalar::most(screen.columns.first - x, 0);
    const std::int32_t end = scalar::least(screen.columns.end - x, kTileWidth);
    return {screen.colors,
            screen.pixel_at(x, y) * 3,
            screen.width * 3,
            end - first == kTileWidth,
            false,
            false,
            first,
            end};
  }

  /// Writes a colour into the pixels `bits` of the lines `rows`.
  static void put_flat(const Target& target, std::uint32_t rows,
                       const std::uint32_t* bits, std::uint32_t packed) {
    const FlatColor color = flat_color(packed);
    for (; rows != 0; rows &= rows - 1) {
      const std::int32_t r = __builtin_ctz(rows);
      store_colors(target.colors, target.at + r * target.stride, bits[r], color,
                   target.whole);
    }
  }

  /// The colours of the polygon that is drawn.
  static const Gradient& gradient_of(const TileView& screen) {
    if constexpr (Simd::kShadesSmall) {
      if (screen.gradient != nullptr) return *screen.gradient;
    }
    return screen.exact->gradient();
  }

  /// Writes an id into the pixels `bits` of the lines `rows` of a tile.
  static void paint_items(const TileView& screen, std::int32_t x,
                          std::int32_t y, std::uint32_t rows,
                          const std::uint32_t* bits, std::int32_t id,
                          bool whole) {
    if (screen.items == nullptr) return;
    const std::int64_t at = screen.pixel_at(x, y);
    for (; rows != 0; rows &= rows - 1) {
      const std::int32_t r = __builtin_ctz(rows);
      store_items(screen.items, at + r * screen.width, bits[r], id, whole);
    }
  }

  /// Writes `source` into the pixels of a tile.
  static void paint(const TileView& screen, std::int32_t x, std::int32_t y,
                    Words8 pixels, const PixelSource& source) {
    if constexpr (Simd::kAddsUp) {
      if (screen.sums != nullptr) {
        const std::int64_t index =
            screen.tile_at(y / kTileHeight, x / kTileWidth);
        return Simd::add_color(screen.sums_of(index), screen.samples, pixels,
                               source.color);
      }
    }
    alignas(32) std::uint32_t bits[kTileHeight];
    store(bits, pixels);
    const std::uint32_t rows = some_of(pixels);
    const Target target = target_of(screen, x, y);
    paint_items(screen, x, y, rows, bits, source.id, target.whole);
    if (screen.colors == nullptr) return;
    if (source.smooth()) {
      put_smooth(target, x, y, rows, bits, source, gradient_of(screen),
                 *screen.exact);
    } else {
      put_flat(target, rows, bits, source.color);
    }
  }

  /// The same back to front, where something may be seen through it.
  static void paint_over(const TileView& screen, std::int32_t x, std::int32_t y,
                         Words8 pixels, const PixelSource& source) {
    if (!screen.exact->blends) {
      paint(screen, x, y, pixels, source);
      return;
    }
    alignas(32) std::uint32_t bits[kTileHeight];
    store(bits, pixels);
    screen.exact->blend(x, y, bits);
  }

  static void release_source(TileView& screen, std::int32_t place) {
    screen.sources[place].uses = screen.spare_source;
    screen.spare_source = place;
  }

  /// Keeps the source of the polygon that is drawn, which is smooth.
  static void keep_source(TileView& screen, const PixelSource& source) {
    const std::int32_t last = screen.last_source;
    if (last != kNone && screen.sources[last].uses == 0)
      release_source(screen, last);
    std::int32_t place = screen.spare_source;
    if (place == kNone) {
      if (screen.source_count == screen.source_capacity) {
        grow_sources(screen);
      }
      place = screen.source_count++;
    } else {
      screen.spare_source = screen.sources[place].uses;
    }
    screen.current_source = screen.last_source = place;
    screen.sources[place] = source;
    screen.sources[place].uses = 0;
    screen.gradients[place] = gradient_of(screen);
  }

  /// A new mask of a tile.
  static void add_mask(TileView& screen, std::int64_t index, Words8 pixels,
                       std::int32_t id, std::uint32_t color,
                       std::int32_t source) {
    std::int32_t place = screen.spare_mask;
    if (place == kNone) {
      if (screen.mask_count == screen.mask_capacity) {
        grow_masks(screen);
      }
      place = screen.mask_count++;
    } else {
      screen.spare_mask = screen.masks[place].next;
    }
    CoverageMask& mask = screen.masks[place];
    store(mask.lit, pixels);
    mask.id = id;
    mask.color = color;
    mask.source = source;
    MaskList& masks = screen.mask_lists[index];
    mask.next = masks.newest;
    masks.newest = place;
    if (masks.oldest == kNone) masks.oldest = place;
    ++masks.count;
  }

  /// Keeps what was lit of a tile until the tile is written.
  static void keep_mask(TileView& screen, std::int64_t index, Words8 pixels,
                        const PixelSource& source) {
    if (!source.smooth() || screen.colors == nullptr) {
      add_mask(screen, index, pixels, source.id, source.color, kNone);
      return;
    }
    if (screen.current_source == kNone) keep_source(screen, source);
    add_mask(screen, index, pixels, source.id, source.color,
             screen.current_source);
    ++screen.sources[screen.current_source].uses;
    ++screen.mask_lists[index].with_source;
  }

  /// Gives a tile's masks back: their memory is used again while it is near.
  static void free_masks(TileView& screen, std::int64_t index) {
    MaskList& masks = screen.mask_lists[index];
    if (masks.newest == kNone) return;
    std::int32_t place = masks.newest;
    for (; masks.with_source > 0; place = screen.masks[place].next) {
      const std::int32_t source = screen.masks[place].source;
      if (source == kNone) continue;
      --masks.with_source;
      if (--screen.sources[source].uses == 0 && source != screen.last_source) {
        release_source(screen, source);
      }
    }
    screen.masks[masks.oldest].next = screen.spare_mask;
    screen.spare_mask = masks.newest;
    masks = {};
  }

  /// The pixels where the polygon that is drawn is nearer, out of the contested
  /// ones, which masks of this leaf have lit.
  static Words8 nearer_of(const TileView& screen, std::int64_t index,
                          std::int32_t x, std::int32_t y, Words8 contested) {
    alignas(32) std::uint32_t bits[kTileHeight];
    Words8 nearer = none();
    std::int32_t place = screen.mask_lists[index].newest;
    for (; any(contested); place = screen.masks[place].next) {
      const CoverageMask& mask = screen.masks[place];
      const Words8 shown = load(mask.lit) & contested;
      if (!any(shown)) continue;
      contested = and_not(contested, shown);
      store(bits, shown);
      screen.exact->nearer(mask.id, x, y, bits);
      nearer = nearer | load(bits);
    }
    return nearer;
  }

  /// Where a tile is put together: its lines of items and of colours.
  struct Composition {
    std::int32_t* items;
    std::int64_t stride;
    Target target;
  };

  /// Writes pixels where a tile is put together.
  static void put(const TileView& screen, const Composition& to, std::int32_t x,
                  std::int32_t y, Words8 pixels, const PixelSource& source,
                  const Gradient* gradient) {
    alignas(32) std::uint32_t bits[kTileHeight];
    const std::uint32_t rows = some_of(pixels);
    store(bits, pixels);
    if (screen.items != nullptr) {
      for (std::uint32_t left = rows; left != 0; left &= left - 1) {
        const std::int32_t r = __builtin_ctz(left);
        store_items(to.items, r * to.stride, bits[r], source.id, true);
      }
    }
    if (screen.colors == nullptr) return;
    if (source.smooth()) {
      put_smooth(to.target, x, y, rows, bits, source, *gradient, *screen.exact);
      return;
    }
    if (to.target.loose) {
      for (std::uint32_t& line : bits) line = ~std::uint32_t{0};
    }
    put_flat(to.target, to.target.loose ? 255u : rows, bits, source.color);
  }

  /// Puts a tile together: what is `at_hand`, if there is a source for it, and
  /// its masks; what was lit later hides the earlier. Gives the pixels that
  /// are in none, or in one that is written.
  static Words8 compose(TileView& screen, Composition to, std::int32_t place,
                        std::int32_t x, std::int32_t y, Words8 at_hand,
                        const PixelSource* source) {
    Words8 rest = every();
    Words8 written = none();
    // The first takes whole lines: the others go over it.
    to.target.loose = true;
    to.target.own = true;
    if (source != nullptr) {
      const bool shades = source->smooth() && screen.colors != nullptr;
      put(screen, to, x, y, at_hand, *source,
          shades ? &gradient_of(screen) : nullptr);
      rest = and_not(rest, at_hand);
      to.target.loose = false;
    }
    for (; place != kNone; place = screen.masks[place].next) {
      const CoverageMask& mask = screen.masks[place];
      const Words8 pixels = load(mask.lit) & rest;
      if (!any(pixels)) continue;
      rest = and_not(rest, pixels);
      if (mask.is_written()) {
        written = written | pixels;
        continue;
      }
      if (mask.source == kNone) {
        put(screen, to, x, y, pixels, {mask.id, mask.color, 0, 0}, nullptr);
      } else {
        put(screen, to, x, y, pixels, screen.sources[mask.source],
            screen.gradients + mask.source);
      }
      to.target.loose = false;
    }
    return rest | written;
  }

  /// Tiles of up to this many masks are put together in the image. Lines there
  /// begin anywhere, which makes more masks slower than a tile of its own.
  /// Without them frames with items and smooth colours of large triangles take
  /// 2 to 5 % longer.
  static constexpr std::int32_t kMasksInImage = 3;

  /// Whether few masks, and `covered`, cover all of a tile.
  static bool is_covered_by_few(const TileView& screen, const MaskList& masks,
                                Words8 covered) {
    if (masks.count > kMasksInImage) return false;
    std::int32_t place = masks.newest;
    for (; place != kNone; place = screen.masks[place].next) {
      covered = covered | load(screen.masks[place].lit);
    }
    return all(covered);
  }

  /// Copies the pixels `bits` of a tile to the images from where it was put
  /// together.
  static void copy_tile(const TileView& screen, std::int32_t x, std::int32_t y,
                        const std::uint32_t* bits) {
    const std::int32_t first = scalar::most(screen.columns.first - x, 0);
    const std::int32_t end = scalar::least(screen.columns.end - x, kTileWidth);
    const auto count = static_cast<std::size_t>(end - first);
    const bool whole = end - first == kTileWidth;
    const std::uint32_t line_bits =
        (~std::uint32_t{0} >> (kTileWidth - (end - first))) << first;
    std::int64_t line = screen.pixel_at(x, y);
    for (std::int32_t r = 0; r < kTileHeight; ++r, line += screen.width) {
      if (bits[r] == 0) continue;
      const bool all_told = bits[r] == line_bits;
      const std::int32_t from = r * kTileWidth;
      if (screen.items != nullptr) {
        std::int32_t* to = screen.items + line;
        const std::int32_t* items = screen.tile_items + from;
        if (!all_told) {
          copy_some_items(to, items, bits[r], whole);
        } else if (whole) {
          copy_items(to, items);
        } else {
          __builtin_memcpy(to + first, items + first, 4 * count);
        }
      }
      if (screen.colors != nullptr) {
        std::uint8_t* to = screen.colors + 3 * line;
        const std::uint8_t* colors = screen.tile_colors + 3 * from;
        if (!all_told) {
          copy_some_colors(to, colors, bits[r], whole);
        } else if (whole) {
          copy_colors(to, colors);
        } else {
          __builtin_memcpy(to + 3 * first, colors + 3 * first, 3 * count);
        }
      }
    }
  }

  /// Adds up the colours of what is `at_hand`, if there is a source for it, and
  /// of the masks of a tile; what was lit later hides the earlier.
  static void add_tile(TileView& screen, std::int64_t index, Words8 at_hand,
                       const PixelSource* source) {
    if constexpr (Simd::kAddsUp) {
      std::uint16_t* sums = screen.sums_of(index);
      Words8 rest = every();
      if (source != nullptr) {
        Simd::add_color(sums, screen.samples, at_hand, source->color);
        rest = and_not(rest, at_hand);
      }
      std::int32_t place = screen.mask_lists[index].newest;
      for (; place != kNone; place = screen.masks[place].next) {
        const CoverageMask& mask = screen.masks[place];
        const Words8 lit = load(mask.lit);
        Simd::add_color(sums, screen.samples, lit & rest, mask.color);
        rest = and_not(rest, lit);
      }
    }
    free_masks(screen, index);
  }

  /// Writes the masks of a tile, and what is `at_hand` if there is an
  /// source for it.
  static void write_tile(TileView& screen, std::int64_t index, std::int32_t x,
                         std::int32_t y, Words8 at_hand,
                         const PixelSource* source) {
    if (adds_up(screen)) return add_tile(screen, index, at_hand, source);
    const MaskList masks = screen.mask_lists[index];
    const Target target = target_of(screen, x, y);
    const bool whole = target.whole && masks.written == 0;
    if (screen.items == nullptr && screen.colors != nullptr &&
        write_flat(screen, masks, whole, x, y, at_hand, source)) {
      free_masks(screen, index);
      return;
    }
    if (whole && is_covered_by_few(screen, masks,
                                   source != nullptr ? at_hand : none())) {
      const Composition in_image = {screen.items == nullptr
                                        ? nullptr
                                        : screen.items + screen.pixel_at(x, y),
                                    screen.width, target};
      compose(screen, in_image, masks.newest, x, y, at_hand, source);
      free_masks(screen, index);
      return;
    }
    const Composition aside = {screen.tile_items,
                               kTileWidth,
                               {screen.tile_colors, 0, kTileWidth * 3, true,
                                true, true, 0, kTileWidth}};
    const Words8 uncovered =
        compose(screen, aside, masks.newest, x, y, at_hand, source);
    free_masks(screen, index);
    alignas(32) std::uint32_t bits[kTileHeight];
    store(bits, and_not(every(), uncovered));
    copy_tile(screen, x, y, bits);
  }
};

}  // namespace halfspace::fast
