#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "camera/view.hpp"
#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {

/// Small polygons of a leaf, eight at a time.
template <class Base>
struct SmallPolygons : Base {
  using Base::add_mask, Base::contested_of, Base::keep_mask;
  using Base::and_not, Base::any, Base::bits_of, Base::ceiling, Base::cover_of;
  using Base::differ, Base::doubles, Base::first_centre, Base::floats8;
  using Base::greater, Base::kLanes, Base::kParts, Base::lanes;
  using Base::light_in_leaf, Base::merge_ordered, Base::paint;
  using Base::line_centres, Base::lines_between, Base::load, Base::mask_of,
      Base::not_less;
  using Base::paint_over, Base::put_runs;
  using Base::select, Base::size_of, Base::smaller, Base::some_of, Base::store;
  using Base::to_words, Base::widened;
  using typename Base::Doubles8, typename Base::FloatMask;
  using typename Base::Floats8, typename Base::LaneMask, typename Base::Lanes;
  using typename Base::Words8;

  /// Paints pixels of a tile and keeps them as a mask that is written.
  [[gnu::noinline]] static void paint_at_once(TileView& screen,
                                              std::int32_t row,
                                              std::int32_t tile, Words8 pixels,
                                              const PixelSource& source) {
    const std::int32_t x = tile * kTileWidth;
    const std::int32_t y = row * kTileHeight;
    if (source.smooth() || screen.items != nullptr ||
        screen.colors == nullptr) {
      paint(screen, x, y, pixels, source);
    } else {
      put_runs(screen, x, y, pixels, source.color);
    }
    const std::int64_t index = screen.tile_at(row, tile);
    add_mask(screen, index, pixels, source.id, CoverageMask::kWritten, kNone);
    ++screen.mask_lists[index].written;
  }

  /// More masks a tile than this take longer to write one by one than to put
  /// together.
  static constexpr float kManyMasks = 5;

  /// merge_in_leaf() for small polygons, which paints at once, unless the last
  /// leaves lit many masks of a tile.
  static void merge_small(TileView& screen, std::int32_t row, std::int32_t tile,
                          Words8 cover, const PixelSource& source) {
    const Words8 painted = light_in_leaf(screen, row, tile, cover);
    if (!any(painted)) return;
    // What is added up cannot be written over.
    if (screen.recent_masks <= kManyMasks * screen.recent_tiles &&
        !Base::adds_up(screen)) {
      paint_at_once(screen, row, tile, painted, source);
    } else {
      keep_mask(screen, screen.tile_at(row, tile), painted, source);
    }
  }

  /// Polygons larger than this are not small. Units: pixels.
  static constexpr double kSmall = 64;

  /// As in PolygonRasterizer: beyond these a polygon is decided line by line.
  static constexpr double kMostImageError = 0x1p-10;
  static constexpr double kFarthestImage = 0x1p30;

  /// A bit for each lane.
  static constexpr std::uint32_t kLaneBits = (1u << kLanes) - 1;

  /// Eight polygons in the image.
  template <std::size_t kCorners>
  struct Projected8 {
    Doubles8 x[kCorners];
    Doubles8 y[kCorners];
    Doubles8 weight[kCorners];  ///< the reciprocals of depths, or 1
    Doubles8 weight_error;      ///< in parts of themselves
    Doubles8 first_depth;
    Doubles8 error;
    Doubles8 y_least;
    Doubles8 y_most;
    alignas(32) std::int32_t first_column[8];
    alignas(32) std::int32_t end_column[8];
    alignas(32) std::int32_t first_line[8];
    alignas(32) std::int32_t end_line[8];
    std::uint32_t displayed =
        0;                     ///< those that the eye is on the wanted side of
    std::uint32_t inside = 0;  ///< those of them that may cover a sample
    std::uint32_t left = 0;    ///< those that this is too little for
    std::uint32_t turn = 0;    ///< those that turn from x to y
  };

  /// Points, one a lane.
  struct Points {
    Lanes x;
    Lanes y;
    Lanes z;
  };

  static Lanes widened(const std::array<float, 8>& of, int part) {
    return widened(of.data() + kLanes * part);
  }

  /// Corner c of those of a block's fragments that are in the part.
  template <std::size_t kCorners>
  static Points corner_of(const FragmentBlock<kCorners>& block, std::size_t c,
                          int part) {
    return {widened(block.x[c], part) + lanes(block.origin[0]),
            widened(block.y[c], part) + lanes(block.origin[1]),
            widened(block.z[c], part) + lanes(block.origin[2])};
  }

  /// Projects the polygons of a part: PolygonRasterizer::project() for each.
  template <std::size_t kCorners>
  static void project_lanes(const View& view,
                            const FragmentBlock<kCorners>& block, int part,
                            Projected8<kCorners>& seen) {
    const auto at = [](const double* f, Lanes x, Lanes y, Lanes z) {
      return lanes(f[0]) * x + lanes(f[1]) * y + lanes(f[2]) * z + lanes(f[3]);
    };
    const Lanes vertex_error = widened(block.error, part);
    const Lanes t_error =
        (lanes(view.t_error) + lanes(view.t_growth) * vertex_error) *
        lanes(1 + 0x1p-48);
    const Lanes xy_error =
        lanes(view.xy_error) + lanes(view.xy_growth) * vertex_error;
    const double x_of[4] = {view.x.a, view.x.b, view.x.c, view.x.d};
    const double y_of[4] = {view.y.a, view.y.b, view.y.c, view.y.d};
    const double t_of[4] = {view.t.a, view.t.b, view.t.c, view.t.d};
    const Lanes near = lanes(view.near);
    LaneMask behind = lanes(0) < lanes(1);
    LaneMask doubtful = lanes(1) < lanes(0);
    Lanes error = lanes(0);
    [[maybe_unused]] Lanes nearest = lanes(0);
    for (std::size_t c = 0; c < kCorners; ++c) {
      const auto [vx, vy, vz] = corner_of(block, c, part);
      const Lanes t = at(t_of, vx, vy, vz);
      behind = behind & (t + t_error < near);
      doubtful = doubtful | not_less(near, t - t_error);
      Lanes x = at(x_of, vx, vy, vz);
      Lanes y = at(y_of, vx, vy, vz);
      Lanes doubt = xy_error;
      if constexpr (Base::kShadesSmall) seen.weight[c].part[part] = lanes(1);
      if (view.perspective) {
        const Lanes reciprocal = lanes(1) / t;
        if constexpr (Base::kShadesSmall) {
          if (c == 0) seen.first_depth.part[part] = t;
          seen.weight[c].part[part] = reciprocal;
          nearest = greater(nearest, reciprocal);
        }
        x = x * reciprocal;
        y = y * reciprocal;
        // 1 / (t - b) is at most (1 + 2^-10) / t where b is at most t / 2048.
        doubtful = doubtful | not_less(lanes(2048) * t_error, t);
        doubt = (doubt + t_error * greater(size_of(x), size_of(y))) *
                (reciprocal * lanes(1 + 0x1p-9));
      }
      const Lanes size = greater(size_of(x), size_of(y));
      error = greater(error, doubt + lanes(4 * 0x1p-53) * size);
      doubtful = doubtful | not_less(size, lanes(kFarthestImage));
      seen.x[c].part[part] = x;
      seen.y[c].part[part] = y;
    }
    if constexpr (Base::kShadesSmall) {
      if (!view.perspective) seen.first_depth.part[part] = lanes(1);
      // t is off by at most 1 / 2048 of itself: see above.
      seen.weight_error.part[part] =
          view.perspective ? t_error * nearest * lanes(1 + 0x1p-9) : lanes(0);
    }
    error = error * lanes(1 + 0x1p-40);
    doubtful = doubtful | not_less(error, lanes(kMostImageError));
    seen.error.part[part] = error;
    const std::uint32_t unseen = bits_of(behind);
    seen.displayed |= (~unseen & kLaneBits) << (kLanes * part);
    seen.left |= (bits_of(doubtful) & ~unseen) << (kLanes * part);
  }

  /// Which way they turn, and which of them the eye is on the wanted side of:
  /// PolygonRasterizer::turn() for each.
  template <std::size_t kCorners>
  static void turn_lanes(const View& view, bool cull, int part,
                         Projected8<kCorners>& seen) {
    Lanes x = seen.x[1].part[part] - seen.x[0].part[part];
    Lanes y = seen.y[1].part[part] - seen.y[0].part[part];
    Lanes area = lanes(0);
    Lanes extent = greater(size_of(x), size_of(y));
    for (std::size_t c = 2; c < kCorners; ++c) {
      const Lanes next_x = seen.x[c].part[part] - seen.x[0].part[part];
      const Lanes next_y = seen.y[c].part[part] - seen.y[0].part[part];
      area = area + (x * next_y - y * next_x);
      extent = greater(extent, greater(size_of(next_x), size_of(next_y)));
      x = next_x;
      y = next_y;
    }
    const Lanes error = seen.error.part[part];
    const Lanes doubt = lanes(double{9} * (kCorners - 2)) * (extent + error) *
                        (error + lanes(8 * 0x1p-53) * extent);
    const std::uint32_t positive = bits_of(doubt < area);
    const std::uint32_t negative = bits_of(area < lanes(0) - doubt);
    seen.turn |= positive << (kLanes * part);
    seen.left |= (~(positive | negative) & kLaneBits &
                  (seen.displayed >> (kLanes * part)))
                 << (kLanes * part);
    if (!cull) return;
    const std::uint32_t culled = view.orientation > 0 ? positive : negative;
    const std::uint32_t doubted = (seen.left >> (kLanes * part)) & kLaneBits;
    seen.displayed &= ~((culled & ~doubted) << (kLanes * part));
  }

  /// The lines and columns that they may cover.
  template <std::size_t kCorners>
  static void bound_lanes(const TileView& screen, int part,
                          Projected8<kCorners>& seen) {
    const auto& x = seen.x;
    const auto& y = seen.y;
    const Lanes error = seen.error.part[part];
    Lanes x_least = x[0].part[part], x_most = x_least;
    Lanes y_least = y[0].part[part], y_most = y_least;
    for (std::size_t c = 1; c < kCorners; ++c) {
      x_least = smaller(x_least, x[c].part[part]);
      x_most = greater(x_most, x[c].part[part]);
      y_least = smaller(y_least, y[c].part[part]);
      y_most = greater(y_most, y[c].part[part]);
    }
    const Lanes first = first_centre(y_least - error);
    const Lanes end = first_centre(y_most + error);
    const Lanes first_column =
        greater(first_centre(x_least - error), lanes(screen.columns.first));
    const Lanes end_column =
        smaller(first_centre(x_most + error), lanes(screen.columns.end));
    const Lanes first_line = greater(first, lanes(screen.lines.first));
    const Lanes end_line = smaller(end, lanes(screen.lines.end));
    const LaneMask inside =
        (first_column < end_column) & (first_line < end_line);
    // Lines that may be covered, but not for sure.
    const LaneMask doubtful = differ(first, first_centre(y_least + error)) |
                              differ(end, first_centre(y_most - error));
    const LaneMask large = not_less(x_most - x_least, lanes(kSmall)) |
                           not_less(y_most - y_least, lanes(kSmall));
    seen.y_least.part[part] = y_least;
    seen.y_most.part[part] = y_most;
    store(seen.first_column + kLanes * part, first_column);
    store(seen.end_column + kLanes * part, end_column);
    store(seen.first_line + kLanes * part, first_line);
    store(seen.end_line + kLanes * part, end_line);
    seen.inside |= bits_of(inside) << (kLanes * part);
    seen.left |= (bits_of(inside & (doubtful | large)) &
                  (seen.displayed >> (kLanes * part)))
                 << (kLanes * part);
  }

  /// One edge, or none, of each of eight polygons.
  struct Sides8 {
    alignas(32) float low[8];  ///< the lowest reading of where it is
    alignas(32) float slope[8];
    alignas(32) float doubt[8];  ///< from there to the highest
  };

  /// The edges of eight polygons, counted from their first tiles: a column is
  /// at least each of the left ones and at most each of the right ones.
  template <std::size_t kCorners>
  struct Edges8 {
    Sides8 left[kCorners - 1];
    Sides8 right[kCorners - 1];
  };

  /// An edge, or none, for each of eight polygons.
  struct Edge8 {
    Floats8 low;
    Floats8 slope;
    Floats8 doubt;
  };
  static Edge8 select(const Edge8& a, const Edge8& b, FloatMask mask) {
    return {select(a.low, b.low, mask), select(a.slope, b.slope, mask),
            select(a.doubt, b.doubt, mask)};
  }
  template <std::size_t kMost>
  static void push(Edge8 (&edges)[kMost], const Edge8& edge, FloatMask mask) {
    for (std::size_t e = kMost - 1; e > 0; --e) {
      edges[e] = select(edges[e], edges[e - 1], mask);
    }
    edges[0] = select(edges[0], edge, mask);
  }
  static void store(Sides8& sides, const Edge8& edge) {
    store(sides.low, edge.low);
    store(sides.slope, edge.slope);
    store(sides.doubt, edge.doubt);
  }

  /// Enters the edges of eight polygons: EdgeSetup::enter() in floats.
  ///
  /// Coordinates count from the first tile's corner and are at most 128, so a
  /// corner is off by 2^-18 more than in doubles; D becomes that and the
  /// doubles' error, at most 2^-10 + 2^-17, and 2 D (1 + |m|) / (|dy| - 2 D) is
  /// at most 2.4 D (1 + |m|) / |dy|. Rounding, u = 2^-24 for a float, h the
  /// height, s the slope's size: the slope by 4u, so x by 4u (h + 1) s; y0 m
  /// and y m by u (2 |y0| + h + 1) s; the three sums with them, and the halves
  /// and bounds taken off, by 4u (|x0| + (|y0| + h + 1) s + 1) at most. 8u
  /// times what enter() has covers that.
  template <std::size_t kCorners>
  static void enter_eight(const Projected8<kCorners>& seen,
                          Edges8<kCorners>& edges, std::uint32_t& left) {
    Floats8 x[kCorners], y[kCorners];
    alignas(32) std::int32_t column[8], line[8];
    for (int k = 0; k < 8; ++k) {
      column[k] = seen.first_column[k] & -kTileWidth;
      line[k] = seen.first_line[k] & -kTileHeight;
    }
    const Doubles8 left_end =
        doubles([&](int p) { return widened(column + kLanes * p); });
    const Doubles8 top =
        doubles([&](int p) { return widened(line + kLanes * p); });
    for (std::size_t c = 0; c < kCorners; ++c) {
      x[c] = floats8(seen.x[c] - left_end);
      y[c] = floats8(seen.y[c] - top);
    }
    const Floats8 error =
        floats8(seen.error) * floats8(1 + 0x1p-20f) + floats8(0x1p-17f);
    const Floats8 height = floats8(seen.y_most - seen.y_least);
    const FloatMask negative_turn = mask_of(~seen.turn);
    const Edge8 no_left = {floats8(-1e6f), floats8(0), floats8(0)};
    const Edge8 no_right = {floats8(1e6f), floats8(0), floats8(0)};
    Edge8 lefts[kCorners - 1];
    Edge8 rights[kCorners - 1];
    for (std::size_t e = 0; e < kCorners - 1; ++e) {
      lefts[e] = no_left;
      rights[e] = no_right;
    }
    FloatMask some_left = mask_of(0), some_right = mask_of(0),
              doubtful = mask_of(0);
    for (std::size_t c = 0; c < kCorners; ++c) {
      const std::size_t next = c == kCorners - 1 ? 0 : c + 1;
      const Floats8 dy = y[next] - y[c];
      const Floats8 size = size_of(dy);
      const FloatMask flat = size < floats8(1.0f / 64);
      const Floats8 reciprocal = floats8(1) / dy;
      const Floats8 slope = (x[next] - x[c]) * reciprocal;
      const Floats8 steep = size_of(slope);
      const Floats8 doubt =
          error * (floats8(1) + steep) *
              (floats8(1) + floats8(3) * height * size_of(reciprocal)) +
          floats8(8 * 0x1p-24f) *
              (size_of(x[c]) +
               (floats8(2) * size_of(y[c]) + height + floats8(2)) * steep +
               floats8(1));
      // A flat edge bounds nothing, unless a line's centre is near it.
      const FloatMask near = first_centre(smaller(y[c], y[next]) - error) <
                             first_centre(greater(y[c], y[next]) + error);
      doubtful = doubtful | (flat & near);
      const FloatMask right = (floats8(0) < dy) ^ negative_turn;
      const Floats8 bound = doubt * floats8(1 + 0x1p-16f) + floats8(0x1p-17f);
      const Edge8 edge = {x[c] - y[c] * slope - floats8(0.5f) - bound, slope,
                          bound + bound};
      const FloatMask is_right = and_not(right, flat);
      const FloatMask is_left = and_not(mask_of(255), right | flat);
      push(rights, edge, is_right);
      push(lefts, edge, is_left);
      some_right = some_right | is_right;
      some_left = some_left | is_left;
    }
    left |= (bits_of(doubtful) | ~bits_of(some_left & some_right)) & 255u;
    for (std::size_t e = 0; e < kCorners - 1; ++e) {
      store(edges.left[e], lefts[e]);
      store(edges.right[e], rights[e]);
    }
  }

  /// The columns of a polygon on eight lines.
  struct Columns8 {
    Words8 first;
    Words8 end;
    Words8 lines;  ///< those that it may cover
    bool doubtful = false;
  };

  template <std::size_t kCorners>
  static Columns8 columns_of(const Edges8<kCorners>& edges, int k,
                             std::int32_t top, std::int32_t first_line,
                             std::int32_t end_line) {
    const Floats8 y = line_centres(static_cast<float>(top));
    Floats8 left_low, left_high, right_low, right_high;
    for (std::size_t e = 0; e < kCorners - 1; ++e) {
      const Sides8& left = edges.left[e];
      const Sides8& right = edges.right[e];
      const Floats8 low = floats8(left.low[k]) + floats8(left.slope[k]) * y;
      const Floats8 high = low + floats8(left.doubt[k]);
      const Floats8 right_lower =
          floats8(right.low[k]) + floats8(right.slope[k]) * y;
      const Floats8 right_higher = right_lower + floats8(right.doubt[k]);
      left_low = e == 0 ? low : greater(left_low, low);
      left_high = e == 0 ? high : greater(left_high, high);
      right_low = e == 0 ? right_lower : smaller(right_low, right_lower);
      right_high = e == 0 ? right_higher : smaller(right_high, right_higher);
    }
    const Floats8 first = ceiling(left_low);
    const Floats8 end = ceiling(right_high);
    const Words8 lines = lines_between(first_line, end_line);
    const FloatMask unsure =
        differ(first, ceiling(left_high)) | differ(end, ceiling(right_low));
    // Where even the widest reading is empty there is nothing to decide.
    const std::uint32_t doubtful =
        bits_of(unsure & (first < end)) & some_of(lines);
    return {to_words(first), to_words(end), lines, doubtful != 0};
  }

  template <std::size_t kCorners>
  static Columns8 columns_in_row(const Projected8<kCorners>& seen,
                                 const Edges8<kCorners>& edges, int k,
                                 std::int32_t row) {
    const std::int32_t first_top = seen.first_line[k] & -kTileHeight;
    const std::int32_t top = row * kTileHeight;
    return columns_of(edges, k, top - first_top, seen.first_line[k] - top,
                      seen.end_line[k] - top);
  }

  template <std::size_t kCorners>
  static bool is_doubtful(const Projected8<kCorners>& seen,
                          const Edges8<kCorners>& edges, int k) {
    const std::int32_t last_row = (seen.end_line[k] - 1) / kTileHeight;
    for (std::int32_t row = seen.first_line[k] / kTileHeight; row <= last_row;
         ++row) {
      if (columns_in_row(seen, edges, k, row).doubtful) return true;
    }
    return false;
  }

  /// The colours of the k-th of eight, if it is a whole smooth triangle: from
  /// its corners in the image, which takes less than from those in space.
  template <std::size_t kCorners>
  static void start_gradient(TileView& screen, const Projected8<kCorners>& seen,
                             int k, Gradient& gradient) {
    screen.gradient = nullptr;
    if constexpr (Base::kShadesSmall && kCorners == 3) {
      if (screen.corner_colors == nullptr) return;
      const auto lane = [k](const Doubles8& of) {
        double value;
        __builtin_memcpy(&value, reinterpret_cast<const char*>(&of) + 8 * k, 8);
        return value;
      };
      SmallTriangle t;
      for (std::size_t c = 0; c < 3; ++c) {
        t.x[c] = lane(seen.x[c]);
        t.y[c] = lane(seen.y[c]);
        t.weight[c] = lane(seen.weight[c]);
      }
      t.first_depth = lane(seen.first_depth);
      t.error = lane(seen.error);
      t.weight_error = lane(seen.weight_error);
      if (Base::small_gradient(t, screen.corner_colors, gradient)) {
        screen.gradient = &gradient;
      }
    }
  }

  /// Draws the k-th of eight; false: it needs more than this.
  template <std::size_t kCorners>
  static bool draw_one(TileView& screen, const Projected8<kCorners>& seen,
                       const Edges8<kCorners>& edges, int k) {
    const std::int32_t first_tile = seen.first_column[k] / kTileWidth;
    const std::int32_t last_tile = (seen.end_column[k] - 1) / kTileWidth;
    const std::int32_t first_row = seen.first_line[k] / kTileHeight;
    const std::int32_t last_row = (seen.end_line[k] - 1) / kTileHeight;
    // Where all is decided elsewhere nothing is shown here: twice is too often.
    if constexpr (Base::kShowsSmall) {
      if (screen.overwrite && is_doubtful(seen, edges, k)) return false;
    }
    bool begun = false;
    PixelSource source;
    Gradient gradient;
    for (std::int32_t row = first_row; row <= last_row; ++row) {
      const std::uint64_t* open = screen.open + screen.open_at(row);
      Columns8 columns;
      bool ready = false;
      for (std::int32_t tile = first_tile; tile <= last_tile; ++tile) {
        if (((open[tile / 64] >> (tile % 64)) & 1u) == 0) continue;
        if (!ready) {
          ready = true;
          columns = columns_in_row(seen, edges, k, row);
          if (columns.doubtful) return false;
        }
        const Words8 cover = cover_of(columns.first, columns.end,
                                      (tile - first_tile) * kTileWidth) &
                             columns.lines;
        const std::int64_t index = screen.tile_at(row, tile);
        const Words8 was = load(screen.lit + index * kTileHeight);
        if (!any(and_not(cover, was)) &&
            !any(contested_of(screen, index, cover, was))) {
          continue;
        }
        if (!begun) {
          begun = true;
          screen.current_source = kNone;
          source =
              screen.exact->begin(k, ((seen.turn >> k) & 1u) != 0 ? 1 : -1);
          start_gradient(screen, seen, k, gradient);
        }
        if (Base::kShowsSmall && screen.overwrite) {
          paint_over(screen, tile * kTileWidth, row * kTileHeight,
                     and_not(cover, was), source);
          ++screen.touches;
        } else if (screen.in_leaf) {
          merge_small(screen, row, tile, cover, source);
        } else {
          merge_ordered(screen, row, tile, cover, source);
        }
      }
    }
    return true;
  }

  template <std::size_t kCorners>
  static BlockDrawn draw_block(TileView& screen, const View& view, bool cull,
                               const FragmentBlock<kCorners>& block) {
    if (!Base::kShowsSmall && screen.overwrite) {
      return {0, (1u << block.count) - 1};
    }
    Projected8<kCorners> seen;
    for (int part = 0; part < kParts; ++part) {
      project_lanes(view, block, part, seen);
      turn_lanes(view, cull, part, seen);
      bound_lanes(screen, part, seen);
    }
    const std::uint32_t displayed = seen.displayed & ((1u << block.count) - 1);
    BlockDrawn drawn;
    drawn.left = seen.left & displayed;
    const std::uint32_t known = displayed & ~drawn.left;
    drawn.displayed = __builtin_popcount(known);
    const std::uint32_t inside = known & seen.inside;
    if (inside == 0) return drawn;
    if constexpr (Base::kShadesSmall) screen.exact->fetch(inside);
    Edges8<kCorners> edges;
    std::uint32_t undecided = 0;
    enter_eight(seen, edges, undecided);
    for (std::uint32_t some = inside; some != 0; some &= some - 1) {
      const int k = __builtin_ctz(some);
      const bool is_drawn =
          ((undecided >> k) & 1u) == 0 && draw_one(screen, seen, edges, k);
      screen.gradient = nullptr;  // it was draw_one()'s
      if (is_drawn) continue;
      drawn.left |= 1u << k;
      --drawn.displayed;
    }
    return drawn;
  }
};

}  // namespace halfspace::fast
