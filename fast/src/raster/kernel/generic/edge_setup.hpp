#pragma once

#include <cstdint>

#include "raster/kernel/generic/scalar.hpp"
#include "raster/kernel/tile_view.hpp"

namespace halfspace::fast {

/// The edges of an outline and the spans between them.
template <class Simd>
struct EdgeSetup : Simd {
  using Simd::all_lines, Simd::columns_of, Simd::greater, Simd::kMostBounds;
  using Simd::lines_from, Simd::smaller;
  using typename Simd::Doubles8, typename Simd::Spans;

  /// An edge that bounds lines from the left or from the right: x + y slope.
  struct Bound {
    double x;
    double slope;
  };

  /// The edges of an outline on one side.
  struct Side {
    Bound bounds[kMostBounds];
    std::int32_t count = 0;
    double error = 0;  ///< of none of them more
  };

  /// The edges of an outline, and the lines they leave in doubt.
  struct Bounds {
    Side left;
    Side right;
    std::int32_t doubtful_count = 0;
    std::int32_t doubtful[kMostBounds];
  };

  /// Below this height an edge is not followed: its one line is decided
  /// exactly.
  static constexpr double kFlat = 1.0 / 64;

  /// Enters one edge. `height` is that of the outline's lines.
  ///
  /// Let D bound the corners' error, m = dx / dy, and M the true slope. Then
  /// |M - m| <= 2D (1 + |m|) / (|dy| - 2D), at most 2.3 D (1 + |m|) / |dy|
  /// since |dy| >= 2^-6 and D <= 2^-10 (the caller sees to it). On a line at
  /// most `height` away the edge's x is off by D (1 + |m|) from its start and
  /// by height + 2D times that from its slope; 3 covers 2.3 and the 2D.
  /// Rounding: m by 3u, the product and y - y0 by u each, the sum by u of |x|,
  /// here taken as x0 - y0 m plus y m: 8u of their sizes.
  static void enter(Bounds& bounds, double x0, double y0, double x1, double y1,
                    double error, double height, std::int32_t turn) {
    const double dy = y1 - y0;
    const std::int32_t from =
        scalar::first_centre(scalar::in_reach(scalar::least(y0, y1) - error));
    const std::int32_t to =
        scalar::first_centre(scalar::in_reach(scalar::most(y0, y1) + error));
    if (from >= to) return;  // no line's centre is near it
    if (scalar::size_of(dy) < kFlat) {
      bounds.doubtful[bounds.doubtful_count++] = from;
      return;
    }
    const double slope = (x1 - x0) / dy;
    const double steep = scalar::size_of(slope);
    const double doubt =
        error * (1 + steep) * (1 + 3 * height / scalar::size_of(dy)) +
        8 * 0x1p-53 *
            (scalar::size_of(x0) +
             (2 * scalar::size_of(y0) + height + 2) * steep + 1);
    Side& side = (dy > 0) == (turn > 0) ? bounds.right : bounds.left;
    side.bounds[side.count++] = {x0 - y0 * slope, slope};
    side.error = scalar::most(side.error, doubt * (1 + 0x1p-40));
  }

  /// The pixels of 8 lines between the bounds, where doubles decide them; the
  /// others as bits.
  ///
  /// The greatest of the left edges is off by at most the largest of their
  /// errors, and so is the least of the right ones.
  static Spans spans(const TileView& screen, const Bounds& bounds, double top) {
    const Doubles8 y = lines_from(top);
    Doubles8 left = all_lines(-1e6);
    for (std::int32_t k = 0; k < bounds.left.count; ++k) {
      const Bound& b = bounds.left.bounds[k];
      left = greater(left, all_lines(b.x) + y * all_lines(b.slope));
    }
    Doubles8 right = all_lines(1e6);
    for (std::int32_t k = 0; k < bounds.right.count; ++k) {
      const Bound& b = bounds.right.bounds[k];
      right = smaller(right, all_lines(b.x) + y * all_lines(b.slope));
    }
    return columns_of(left, bounds.left.error, right, bounds.right.error,
                      screen.columns.first, screen.columns.end);
  }
};

}  // namespace halfspace::fast
