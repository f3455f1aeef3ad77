#pragma once

#include <cstdint>

#include "raster/kernel/generic/coverage_merge.hpp"
#include "raster/kernel/generic/edge_setup.hpp"

namespace halfspace::fast {

/// The entries of the kernel: outlines, row of tiles by row.
template <class Simd>
struct TileRows : CoverageMerge<Simd> {
  using Simd::all, Simd::all_words, Simd::and_not, Simd::any, Simd::every;
  using Simd::lines_between, Simd::load, Simd::none, Simd::some_of, Simd::store;
  using typename Simd::Spans, typename Simd::Words8;
  using Write = TileWrite<Simd>;
  using Write::free_masks, Write::paint, Write::write_tile;
  using Merge = CoverageMerge<Simd>;
  using Merge::close_tile, Merge::count_of, Merge::draw_spans;
  using Edges = EdgeSetup<Simd>;
  using Bounds = typename Edges::Bounds;

  static bool is_any_open(const TileView& screen, PixelRange columns,
                          PixelRange lines) {
    const std::int32_t left = columns.first / kTileWidth;
    const std::int32_t right = (columns.end - 1) / kTileWidth;
    const std::int32_t top = lines.first / kTileHeight;
    const std::int32_t bottom = (lines.end - 1) / kTileHeight;
    const std::int32_t first_word = left / 64;
    const std::int32_t last_word = right / 64;
    const std::uint64_t first_mask = ~std::uint64_t{0} << (left % 64);
    const std::uint64_t last_mask = ~std::uint64_t{0} >> (63 - right % 64);
    const std::uint64_t* open = screen.open + screen.open_at(top) + first_word;
    if (first_word == last_word) {
      const std::uint64_t mask = first_mask & last_mask;
      for (std::int32_t row = top; row <= bottom; ++row) {
        if ((*open & mask) != 0) return true;
        open += screen.words_across;
      }
      return false;
    }
    const std::int32_t count = last_word - first_word;
    for (std::int32_t row = top; row <= bottom; ++row) {
      std::uint64_t any = (open[0] & first_mask) | (open[count] & last_mask);
      for (std::int32_t w = 1; w < count; ++w) any |= open[w];
      if (any != 0) return true;
      open += screen.words_across;
    }
    return false;
  }

  static bool any_open(const TileView& screen, PixelRange columns,
                       PixelRange lines) {
    return is_any_open(screen, columns, lines);
  }

  /// Whether a pixel of these lines and columns of an open tile is unlit.
  static bool is_unlit_in(const TileView& screen, std::int32_t row,
                          std::int32_t tile, PixelRange columns, Words8 lines) {
    const std::int32_t x = tile * kTileWidth;
    const std::int32_t first = scalar::most(columns.first - x, 0);
    const std::int32_t end = scalar::least(columns.end - x, kTileWidth);
    const std::uint32_t bits =
        (~std::uint32_t{0} >> (kTileWidth - (end - first))) << first;
    const Words8 lit =
        load(screen.lit + screen.tile_at(row, tile) * kTileHeight);
    return any(and_not(lines & all_words(bits), lit));
  }

  static bool any_unlit(const TileView& screen, PixelRange columns,
                        PixelRange lines) {
    // A tile that is open and all within has unlit pixels.
    const PixelRange inner_columns = {
        (columns.first + kTileWidth - 1) & -kTileWidth,
        columns.end & -kTileWidth};
    const PixelRange inner_lines = {
        (lines.first + kTileHeight - 1) & -kTileHeight,
        lines.end & -kTileHeight};
    if (inner_columns.first < inner_columns.end &&
        inner_lines.first < inner_lines.end &&
        is_any_open(screen, inner_columns, inner_lines)) {
      return true;
    }
    const std::int32_t first_tile = columns.first / kTileWidth;
    const std::int32_t last_tile = (columns.end - 1) / kTileWidth;
    const std::int32_t last_row = (lines.end - 1) / kTileHeight;
    for (std::int32_t row = lines.first / kTileHeight; row <= last_row; ++row) {
      const std::uint64_t* open = screen.open + screen.open_at(row);
      const std::int32_t top = row * kTileHeight;
      for (std::int32_t w = first_tile / 64; w <= last_tile / 64; ++w) {
        std::uint64_t tiles = open[w];
        if (w == first_tile / 64)
          tiles &= ~std::uint64_t{0} << (first_tile % 64);
        if (w == last_tile / 64) {
          tiles &= ~std::uint64_t{0} >> (63 - last_tile % 64);
        }
        for (; tiles != 0; tiles &= tiles - 1) {
          if (is_unlit_in(screen, row, w * 64 + __builtin_ctzll(tiles), columns,
                          lines_between(lines.first - top, lines.end - top))) {
            return true;
          }
        }
      }
    }
    return false;
  }

  /// The 8 lines of one tile row: finds the spans, settles the doubtful ones
  /// and cuts off the lines outside `lines`.
  static std::int64_t draw_row(TileView& screen, std::int32_t row,
                               const Bounds& bounds, PixelRange lines,
                               PixelRange sure, const PixelSource& source) {
    const std::int32_t top = row * kTileHeight;
    Spans found = Edges::spans(screen, bounds, static_cast<double>(top) + 0.5);
    for (std::int32_t k = 0; k < bounds.doubtful_count; ++k) {
      const std::int32_t r = bounds.doubtful[k] - top;
      if (r >= 0 && r < kTileHeight) found.doubt |= 1u << r;
    }
    // Lines outside are empty.
    const Words8 within = lines_between(lines.first - top, lines.end - top);
    const Words8 unsure =
        and_not(within, lines_between(sure.first - top, sure.end - top));
    found.first = found.first & within;
    found.end = found.end & within;
    std::uint32_t unknown = some_of(unsure) | (found.doubt & some_of(within));
    if (unknown != 0) {
      alignas(32) std::uint32_t first[kTileHeight];
      alignas(32) std::uint32_t end[kTileHeight];
      store(first, found.first);
      store(end, found.end);
      for (; unknown != 0; unknown &= unknown - 1) {
        const std::int32_t r = __builtin_ctz(unknown);
        const PixelRange range =
            screen.exact->exact_line(top + r, screen.columns);
        first[r] = static_cast<std::uint32_t>(range.first);
        end[r] = static_cast<std::uint32_t>(range.end);
      }
      found.first = load(first);
      found.end = load(end);
    }
    return draw_spans(screen, row, found.first, found.end, source);
  }

  static std::int64_t draw(TileView& screen, const Outline& outline,
                           const PixelSource& source) {
    screen.current_source = kNone;
    const double* x = outline.x;
    const double* y = outline.y;
    double x_least = x[0], x_most = x[0], y_least = y[0], y_most = y[0];
    for (std::int32_t k = 1; k < outline.count; ++k) {
      x_least = scalar::least(x_least, x[k]);
      x_most = scalar::most(x_most, x[k]);
      y_least = scalar::least(y_least, y[k]);
      y_most = scalar::most(y_most, y[k]);
    }
    const double error = outline.error;
    // Lines and columns that may be covered, and lines that are for sure.
    const PixelRange lines = {
        scalar::most(scalar::first_centre(scalar::in_reach(y_least - error)),
                     screen.lines.first),
        scalar::least(scalar::first_centre(scalar::in_reach(y_most + error)),
                      screen.lines.end)};
    const PixelRange columns = {
        scalar::most(scalar::first_centre(scalar::in_reach(x_least - error)),
                     screen.columns.first),
        scalar::least(scalar::first_centre(scalar::in_reach(x_most + error)),
                      screen.columns.end)};
    if (lines.first >= lines.end || columns.first >= columns.end) return 0;
    if (!is_any_open(screen, columns, lines)) return 0;
    const PixelRange sure = {
        scalar::first_centre(scalar::in_reach(y_least + error)),
        scalar::first_centre(scalar::in_reach(y_most - error))};

    Bounds bounds;
    for (std::int32_t k = 0; k < outline.count; ++k) {
      const std::int32_t next = k + 1 == outline.count ? 0 : k + 1;
      if (scalar::most(y[k], y[next]) + error + 1 < screen.lines.first ||
          scalar::least(y[k], y[next]) - error - 1 > screen.lines.end) {
        continue;  // not on these lines
      }
      Edges::enter(bounds, x[k], y[k], x[next], y[next], error,
                   y_most - y_least, outline.turn);
    }
    std::int64_t count = 0;
    const std::int32_t last_row = (lines.end - 1) / kTileHeight;
    for (std::int32_t row = lines.first / kTileHeight; row <= last_row; ++row) {
      if (!is_any_open(screen, columns,
                       {row * kTileHeight, row * kTileHeight + 1})) {
        continue;
      }
      count += draw_row(screen, row, bounds, lines, sure, source);
    }
    return count;
  }

  static std::int64_t draw_lines(TileView& screen, PixelRange lines,
                                 const PixelSource& source) {
    screen.current_source = kNone;
    std::int64_t count = 0;
    const std::int32_t last_row = (lines.end - 1) / kTileHeight;
    for (std::int32_t row = lines.first / kTileHeight; row <= last_row; ++row) {
      if (!is_any_open(screen, screen.columns,
                       {row * kTileHeight, row * kTileHeight + 1})) {
        continue;
      }
      alignas(32) std::uint32_t first[kTileHeight];
      alignas(32) std::uint32_t end[kTileHeight];
      for (std::int32_t r = 0; r < kTileHeight; ++r) {
        const std::int32_t j = row * kTileHeight + r;
        PixelRange range = {0, 0};
        if (j >= lines.first && j < lines.end) {
          range = screen.exact->exact_line(j, screen.columns);
        }
        first[r] = static_cast<std::uint32_t>(range.first);
        end[r] = static_cast<std::uint32_t>(range.end);
      }
      count += draw_spans(screen, row, load(first), load(end), source);
    }
    return count;
  }

  static void leave_leaf(TileView& screen) {
    if (!screen.in_leaf) return;
    screen.in_leaf = false;
    std::int32_t mask_count = 0;
    for (std::int32_t k = 0; k < screen.touched_count; ++k) {
      const std::int32_t index = screen.touched[k];
      const bool fills =
          all(load(screen.lit + std::int64_t{index} * kTileHeight));
      const MaskList& masks = screen.mask_lists[index];
      mask_count += masks.count;
      if (!fills && masks.written == 0 && masks.count < screen.most_masks) {
        continue;
      }
      const std::int32_t row = screen.first_row + index / screen.tiles_across;
      const std::int32_t tile = index % screen.tiles_across;
      if (fills) close_tile(screen, row, tile);
      if (masks.written == masks.count) {
        free_masks(screen, index);
        continue;
      }
      write_tile(screen, index, tile * kTileWidth, row * kTileHeight, none(),
                 nullptr);
    }
    const auto remember = [](float& recent, std::int32_t count) {
      recent = recent * 0.875f + static_cast<float>(count);
    };
    remember(screen.recent_tiles, screen.touched_count);
    remember(screen.recent_masks, mask_count);
  }

  static std::int64_t fill_rest(TileView& screen, const PixelSource& source) {
    std::int64_t count = 0;
    const std::int32_t first_row = screen.lines.first / kTileHeight;
    const std::int32_t last_row = (screen.lines.end - 1) / kTileHeight;
    screen.current_source = kNone;
    for (std::int32_t row = first_row; row <= last_row; ++row) {
      for (std::int32_t w = 0; w < screen.words_across; ++w) {
        std::uint64_t tiles = screen.open[screen.open_at(row) + w];
        while (tiles != 0) {
          const std::int32_t tile = w * 64 + __builtin_ctzll(tiles);
          tiles &= tiles - 1;
          const std::int64_t index = screen.tile_at(row, tile);
          const std::int32_t x = tile * kTileWidth;
          const std::int32_t y = row * kTileHeight;
          const Words8 unlit =
              and_not(every(), load(screen.lit + index * kTileHeight));
          count += count_of(unlit);
          if (screen.mask_lists[index].newest == kNone) {
            paint(screen, x, y, unlit, source);
          } else {
            write_tile(screen, index, x, y, unlit, &source);
          }
        }
      }
    }
    return count;
  }

  /// Writes the means of the pixels whose samples are on the screen, where they
  /// are added up. The first is at `means`.
  static void write_means(const TileView& screen, std::uint8_t* means) {
    if constexpr (Simd::kAddsUp) {
      const std::int32_t samples = screen.samples;
      // Of pixels, from the first pixel of the image on.
      const auto within = [samples](PixelRange range, std::int32_t first,
                                    std::int32_t size) {
        return PixelRange{scalar::most(range.first - first, 0) / samples,
                          scalar::least(range.end - first, size) / samples};
      };
      const std::int64_t stride =
          3 * ((screen.columns.end - screen.columns.first) / samples);
      const std::int32_t first_tile = screen.columns.first / kTileWidth;
      const std::int32_t last_tile = (screen.columns.end - 1) / kTileWidth;
      const std::int32_t last_row = (screen.lines.end - 1) / kTileHeight;
      for (std::int32_t row = screen.lines.first / kTileHeight; row <= last_row;
           ++row) {
        const std::int32_t y = row * kTileHeight;
        const PixelRange rows = within(screen.lines, y, kTileHeight);
        for (std::int32_t tile = first_tile; tile <= last_tile; ++tile) {
          const std::int32_t x = tile * kTileWidth;
          std::uint8_t* to = means + (y - screen.top) / samples * stride +
                             3 * ((x - screen.columns.first) / samples);
          Simd::write_tile_means(screen.sums_of(screen.tile_at(row, tile)),
                                 samples, within(screen.columns, x, kTileWidth),
                                 rows, to, stride);
        }
      }
    }
  }
};

}  // namespace halfspace::fast
