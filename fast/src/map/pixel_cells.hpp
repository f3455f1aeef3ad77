#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "halfspace/scene.hpp"
#include "map/cell_tree.hpp"

namespace halfspace::fast {

/// A line of the image, a x + b y + c, in pixels: positive where what it bounds
/// is.
///
/// The greater of `a` and `b` is at least 2 and less than 4 in size; each
/// number is off by at most 2^-52 of itself.
struct PixelLine {
  double a = 0;
  double b = 0;
  double c = 0;
};

/// What is seen of an item in a pixel: its area, and the integrals of x and y
/// over that from the pixel's left top corner.
struct PixelShare {
  PolygonId item = kBackground;
  double area = 0;
  double x = 0;
  double y = 0;
};

/// What PixelCells tells about pixels that are lit.
class PixelSink {
 public:
  virtual ~PixelSink() = default;
  /// One item has all of these pixels of a row.
  virtual void fill(PolygonId item, std::int32_t row, std::int32_t from,
                    std::int32_t end) = 0;
  /// What items have of a pixel. Areas, and the integrals, are off by at most
  /// `error` in all.
  virtual void mix(std::int32_t column, std::int32_t row,
                   std::span<const PixelShare> shares, double error) = 0;
};

/// What of each pixel is still unlit, from front to back: all, nothing, or
/// convex pieces, which what comes is cut out of.
///
/// Where a line passes a corner of a piece within what rounding may do, it
/// passes through it: so polygons that share an edge leave nothing between.
class PixelCells {
 public:
  /// Of an image of so many columns, these rows.
  PixelCells(std::int32_t width, std::int32_t first_row, std::int32_t end_row,
             PixelSink& sink);

  /// Lights what is unlit on the positive side of all lines.
  void light(std::span<const PixelLine> sides, PolygonId item);
  /// What is unlit shows the background: mix() for all that is left of pixels
  /// of which some is lit.
  void finish();

  /// Whether a pixel that may meet the box is not all lit.
  bool any_unlit(const CellBox& box) const;
  bool full() const { return left_ == 0; }
  /// What a line's value is off by at most at a point of the image.
  double line_error() const { return tolerance_; }

 private:
  static constexpr std::int32_t kNone = -1;
  static constexpr int kMostCorners = 8;

  struct Point {
    double x = 0;
    double y = 0;
  };
  /// A convex polygon in a pixel, from its left top corner.
  struct Piece {
    std::int32_t next = kNone;
    std::int32_t count = 0;
    std::array<Point, kMostCorners> corners;
  };
  struct Seen {
    std::int32_t next = kNone;
    PixelShare share;
  };
  /// A pixel that is partly lit.
  struct Pixel {
    std::int32_t column = 0;
    std::int32_t row = 0;
    std::int32_t pieces = kNone;  ///< none: it is done with
    std::int32_t seen = kNone;
    /// How often an area may be off by what rounding does along one line.
    std::int32_t doubts = 0;
  };
  /// Columns of a row: those that the polygon may meet, and of these those that
  /// it covers.
  struct Reach {
    std::int32_t first = 0;
    std::int32_t end = 0;
    std::int32_t full_first = 0;
    std::int32_t full_end = 0;
  };

  bool find_bounds(std::span<const PixelLine> sides);
  bool find_reach(std::span<const PixelLine> sides, std::int32_t row,
                  Reach& reach) const;
  /// Calls visit(column, mask) for groups of 64 pixels of a row in which some
  /// are unlit, with the columns that are meant.
  template <class Visit>
  void for_words(std::int32_t row, std::int32_t first, std::int32_t end,
                 const Visit& visit) const;
  /// Calls visit(column) for the unlit pixels of a row from `first` on.
  template <class Visit>
  void for_unlit(std::int32_t row, std::int32_t first, std::int32_t end,
                 const Visit& visit) const;
  void fill(std::int32_t row, std::int32_t first, std::int32_t end,
            PolygonId item);
  void cut(std::int32_t column, std::int32_t row,
           std::span<const PixelLine> sides, PolygonId item);
  bool cut_piece(const Piece& piece, Pixel& pixel);
  std::int32_t add_pixel(std::int32_t column, std::int32_t row);
  void add_piece(Pixel& pixel, std::span<const Point> corners);
  void add_seen(Pixel& pixel, PolygonId item, std::span<const Point> corners);
  /// All that is left of the pixel is of the item, and it is done with.
  void close(std::int32_t column, std::int32_t row, PolygonId item);
  void mark_lit(std::int32_t column, std::int32_t row);
  double value(const PixelLine& line, const Point& p) const {
    return line.a * p.x + (line.b * p.y + line.c);
  }
  std::size_t index_of(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row - first_row_) *
               static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }
  std::size_t word_of(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row - first_row_) * words_ +
           static_cast<std::size_t>(column / 64);
  }
  static std::uint64_t bit_of(std::int32_t column) {
    return std::uint64_t{1} << (column % 64);
  }
  bool is_begun(std::int32_t column, std::int32_t row) const {
    return (begun_[word_of(column, row)] & bit_of(column)) != 0;
  }
  std::int32_t& left_in_block(std::int32_t column, std::int32_t row) {
    return block_left_[static_cast<std::size_t>((row - first_row_) /
                                                kBlockRows) *
                           words_ +
                       static_cast<std::size_t>(column / 64)];
  }

  static constexpr std::int32_t kBlockRows = 8;

  std::int32_t width_;
  std::int32_t first_row_;
  std::int32_t end_row_;
  PixelSink& sink_;
  double tolerance_;
  std::size_t words_;                 ///< of a row
  std::vector<std::uint64_t> unlit_;  ///< a bit a pixel: not all lit
  std::vector<std::int32_t> block_left_;
  std::size_t left_;
  std::vector<std::uint64_t> begun_;  ///< a bit a pixel: some of it is lit
  /// Of pixels that are begun; others' are not written. Most never are.
  std::unique_ptr<std::int32_t[]> pixel_of_;
  std::vector<Pixel> pixels_;
  std::vector<Piece> pieces_;
  std::vector<Seen> seen_;
  std::int32_t free_piece_ = kNone;
  std::int32_t free_seen_ = kNone;
  std::vector<std::int32_t> free_pixels_;
  // Scratch.
  std::vector<Point> bounds_;
  std::vector<Point> clipped_;
  std::int32_t top_ = 0, bottom_ = 0, leftmost_ = 0, rightmost_ = 0;
  std::vector<PixelLine> active_;  ///< the first of them
  std::size_t active_count_ = 0;
  std::vector<Point> spreads_;  ///< a line's least and most in a pixel
  std::vector<double> values_;
  std::vector<Point> kept_;
  std::vector<Point> inside_;
  std::size_t inside_count_ = 0;
  std::vector<std::span<const Point>> outside_;  ///< the first of them
  std::size_t outside_count_ = 0;
  std::vector<Point> outside_points_;
  std::vector<Point> rest_;
  std::vector<double> inverses_;
  std::vector<PixelShare> shares_;
};

}  // namespace halfspace::fast
