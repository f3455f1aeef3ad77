#include "map/pixel_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "halfspace/assert.hpp"

namespace halfspace::fast {
namespace {

/// How far a row's columns may be off for rounding, in pixels: where an end is
/// in the image it is off by less than 2^-40.
constexpr double kMargin = 0x1p-20;

/// A loop: for a few a call takes longer.
template <class T>
void copy_few(const T* from, std::size_t count, T* to) {
  for (std::size_t k = 0; k < count; ++k) to[k] = from[k];
}

std::int32_t within(double x, std::int32_t low, std::int32_t high) {
  return static_cast<std::int32_t>(
      std::clamp(x, static_cast<double>(low), static_cast<double>(high)));
}

}  // namespace

/// Near a line a x, b y and c are at most 4 s, 4 s and 8 s in an image of s
/// pixels. So their numbers add 2^-52 16 s to what is off, and two roundings of
/// at most 12 s 2^-53 each; within a pixel values are at most 16, and three
/// roundings add 2^-53 48 at most.
PixelCells::PixelCells(std::int32_t width, std::int32_t first_row,
                       std::int32_t end_row, PixelSink& sink)
    : width_(width),
      first_row_(first_row),
      end_row_(end_row),
      sink_(sink),
      tolerance_(0x1p-47 * std::max(width, end_row) + 0x1p-47),
      words_(static_cast<std::size_t>((width + 63) / 64)),
      unlit_(words_ * static_cast<std::size_t>(end_row - first_row),
             ~std::uint64_t{0}),
      block_left_(words_ *
                  static_cast<std::size_t>(
                      (end_row - first_row + kBlockRows - 1) / kBlockRows)),
      left_(static_cast<std::size_t>(width) *
            static_cast<std::size_t>(end_row - first_row)),
      begun_(unlit_.size()),
      pixel_of_(new std::int32_t[left_]) {
  // Room that is seldom written, so that what is there is seldom moved.
  pixels_.reserve(left_ / 8);
  pieces_.reserve(left_ / 8);
  seen_.reserve(left_ / 8);
  const std::int32_t rest = width % 64;
  for (std::int32_t row = first_row; row < end_row; ++row) {
    if (rest != 0)
      unlit_[word_of(width - 1, row)] = (std::uint64_t{1} << rest) - 1;
    for (std::int32_t column = 0; column < width; column += 64)
      left_in_block(column, row) += std::min(64, width - column);
  }
}

void PixelCells::light(std::span<const PixelLine> sides, PolygonId item) {
  if (!find_bounds(sides)) return;
  inverses_.clear();
  spreads_.clear();
  for (const PixelLine& line : sides) {
    inverses_.push_back(1 / line.a);
    spreads_.push_back({std::min(line.a, 0.0) + std::min(line.b, 0.0),
                        std::max(line.a, 0.0) + std::max(line.b, 0.0)});
  }
  if (active_.size() < sides.size()) active_.resize(sides.size());
  if (outside_.size() < sides.size()) outside_.resize(sides.size());
  for (std::int32_t row = top_; row < bottom_; ++row) {
    Reach reach;
    if (!find_reach(sides, row, reach)) continue;
    const auto cut_at = [&](std::int32_t column) {
      cut(column, row, sides, item);
    };
    for_unlit(row, reach.first, reach.full_first, cut_at);
    fill(row, reach.full_first, reach.full_end, item);
    for_unlit(row, reach.full_end, reach.end, cut_at);
  }
}

/// The rectangle of pixels that the polygon may meet; false if there is none.
bool PixelCells::find_bounds(std::span<const PixelLine> sides) {
  const double right = width_;
  const double top = first_row_;
  const double bottom = end_row_;
  bounds_ = {{0, top}, {right, top}, {right, bottom}, {0, bottom}};
  for (const PixelLine& line : sides) {
    clipped_.clear();
    Point before = bounds_.back();
    double value_before = value(line, before) + tolerance_;
    for (const Point& p : bounds_) {
      const double here = value(line, p) + tolerance_;
      if ((here < 0) != (value_before < 0)) {
        const double t = value_before / (value_before - here);
        clipped_.push_back(
            {before.x + t * (p.x - before.x), before.y + t * (p.y - before.y)});
      }
      if (here >= 0) clipped_.push_back(p);
      before = p;
      value_before = here;
    }
    bounds_.swap(clipped_);
    if (bounds_.empty()) return false;
  }
  Point low = bounds_[0];
  Point high = bounds_[0];
  for (const Point& p : bounds_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  leftmost_ = within(std::floor(low.x - kMargin), 0, width_ - 1);
  rightmost_ = within(std::floor(high.x + kMargin), 0, width_ - 1) + 1;
  top_ = within(std::floor(low.y - kMargin), first_row_, end_row_ - 1);
  bottom_ = within(std::floor(high.y + kMargin), first_row_, end_row_ - 1) + 1;
  return true;
}

bool PixelCells::find_reach(std::span<const PixelLine> sides, std::int32_t row,
                            Reach& reach) const {
  double low = leftmost_;
  double high = rightmost_;
  double full_low = low;
  double full_high = high;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const PixelLine& line = sides[k];
    const double inverse = inverses_[k];
    const double above = line.b * row + line.c;
    const double below = above + line.b;
    const double most = std::max(above, below) + tolerance_;
    const double least = std::min(above, below) - tolerance_;
    if (line.a > 0) {
      low = std::max(low, -most * inverse);
      full_low = std::max(full_low, -least * inverse + kMargin);
    } else if (line.a < 0) {
      high = std::min(high, -most * inverse);
      full_high = std::min(full_high, -least * inverse - kMargin);
    } else {
      if (most < 0) return false;
      if (least < 0) full_high = leftmost_;
    }
  }
  reach.first =
      std::max(leftmost_, within(std::floor(low - kMargin), -1, rightmost_));
  reach.end =
      std::min(rightmost_,
               within(std::floor(high + kMargin), leftmost_ - 1, width_) + 1);
  if (reach.first >= reach.end) return false;
  reach.full_first = within(std::ceil(full_low), reach.first, reach.end);
  reach.full_end = within(std::floor(full_high), reach.full_first, reach.end);
  return true;
}

template <class Visit>
void PixelCells::for_words(std::int32_t row, std::int32_t first,
                           std::int32_t end, const Visit& visit) const {
  while (first < end) {
    const std::int32_t base = first / 64 * 64;
    std::uint64_t mask = ~std::uint64_t{0} << (first - base);
    if (end - base < 64) mask &= (std::uint64_t{1} << (end - base)) - 1;
    if ((unlit_[word_of(base, row)] & mask) != 0) visit(base, mask);
    first = base + 64;
  }
}

template <class Visit>
void PixelCells::for_unlit(std::int32_t row, std::int32_t first,
                           std::int32_t end, const Visit& visit) const {
  for_words(row, first, end, [&](std::int32_t base, std::uint64_t mask) {
    for (std::uint64_t bits = unlit_[word_of(base, row)] & mask; bits != 0;
         bits &= bits - 1)
      visit(base + static_cast<std::int32_t>(std::countr_zero(bits)));
  });
}

void PixelCells::fill(std::int32_t row, std::int32_t first, std::int32_t end,
                      PolygonId item) {
  for_words(row, first, end, [&](std::int32_t base, std::uint64_t mask) {
    const std::size_t word = word_of(base, row);
    const std::uint64_t begun = unlit_[word] & begun_[word] & mask;
    std::uint64_t whole = unlit_[word] & ~begun_[word] & mask;
    unlit_[word] &= ~whole;
    left_in_block(base, row) -= std::popcount(whole);
    left_ -= static_cast<std::size_t>(std::popcount(whole));
    while (whole != 0) {
      const int from = std::countr_zero(whole);
      const int count = std::countr_one(whole >> from);
      sink_.fill(item, row, base + from, base + from + count);
      if (from + count == 64) break;
      whole &= ~std::uint64_t{0} << (from + count);
    }
    for (std::uint64_t bits = begun; bits != 0; bits &= bits - 1)
      close(base + static_cast<std::int32_t>(std::countr_zero(bits)), row,
            item);
  });
}

void PixelCells::mark_lit(std::int32_t column, std::int32_t row) {
  unlit_[word_of(column, row)] &= ~bit_of(column);
  --left_in_block(column, row);
  --left_;
}

std::int32_t PixelCells::add_pixel(std::int32_t column, std::int32_t row) {
  std::int32_t id = static_cast<std::int32_t>(pixels_.size());
  if (free_pixels_.empty()) {
    pixels_.emplace_back();
  } else {
    id = free_pixels_.back();
    free_pixels_.pop_back();
  }
  Pixel& pixel = pixels_[static_cast<std::size_t>(id)];
  pixel = {column, row};
  begun_[word_of(column, row)] |= bit_of(column);
  constexpr std::array<Point, 4> kSquare = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  add_piece(pixel, kSquare);
  return id;
}

void PixelCells::add_piece(Pixel& pixel, std::span<const Point> corners) {
  while (corners.size() >= 3) {
    const std::size_t count =
        std::min(corners.size(), std::size_t{kMostCorners});
    std::int32_t id = free_piece_;
    if (id == kNone) {
      id = static_cast<std::int32_t>(pieces_.size());
      pieces_.emplace_back();
    } else {
      free_piece_ = pieces_[static_cast<std::size_t>(id)].next;
    }
    Piece& piece = pieces_[static_cast<std::size_t>(id)];
    piece.count = static_cast<std::int32_t>(count);
    copy_few(corners.data(), count, piece.corners.data());
    piece.next = pixel.pieces;
    pixel.pieces = id;
    if (count == corners.size()) return;
    // The rest is a piece beside it, along a diagonal.
    std::vector<Point> rest(
        corners.begin() + static_cast<std::ptrdiff_t>(count) - 1,
        corners.end());
    rest.push_back(corners[0]);
    rest_.swap(rest);
    corners = rest_;
  }
}

void PixelCells::add_seen(Pixel& pixel, PolygonId item,
                          std::span<const Point> corners) {
  PixelShare sum;
  const Point origin = corners[0];
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Point p = corners[k - 1];
    const Point q = corners[k];
    const double twice = (p.x - origin.x) * (q.y - origin.y) -
                         (p.y - origin.y) * (q.x - origin.x);
    sum.area += twice / 2;
    sum.x += twice * (origin.x + p.x + q.x) / 6;
    sum.y += twice * (origin.y + p.y + q.y) / 6;
  }
  ++pixel.doubts;
  std::int32_t* at = &pixel.seen;
  for (; *at != kNone; at = &seen_[static_cast<std::size_t>(*at)].next) {
    PixelShare& share = seen_[static_cast<std::size_t>(*at)].share;
    if (share.item != item) continue;
    share.area += sum.area;
    share.x += sum.x;
    share.y += sum.y;
    return;
  }
  sum.item = item;
  std::int32_t id = free_seen_;
  if (id == kNone) {
    id = static_cast<std::int32_t>(seen_.size());
    seen_.emplace_back();
  } else {
    free_seen_ = seen_[static_cast<std::size_t>(id)].next;
  }
  seen_[static_cast<std::size_t>(id)] = {pixel.seen, sum};
  pixel.seen = id;
}

void PixelCells::cut(std::int32_t column, std::int32_t row,
                     std::span<const PixelLine> sides, PolygonId item) {
  active_count_ = 0;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const PixelLine& line = sides[k];
    const double c = line.a * column + (line.b * row + line.c);
    if (c + spreads_[k].y < -tolerance_) return;
    if (c + spreads_[k].x < tolerance_)
      active_[active_count_++] = {line.a, line.b, c};
  }
  if (active_count_ == 0) {
    if (is_begun(column, row)) return close(column, row, item);
    mark_lit(column, row);
    return sink_.fill(item, row, column, column + 1);
  }
  std::int32_t& id = pixel_of_[index_of(column, row)];
  if (!is_begun(column, row)) id = add_pixel(column, row);
  Pixel& pixel = pixels_[static_cast<std::size_t>(id)];
  std::int32_t next = pixel.pieces;
  pixel.pieces = kNone;
  while (next != kNone) {
    const std::int32_t piece_id = next;
    Piece& piece = pieces_[static_cast<std::size_t>(piece_id)];
    next = piece.next;
    if (cut_piece(piece, pixel)) {
      piece.next = free_piece_;
      free_piece_ = piece_id;
      add_seen(pixel, item, {inside_.data(), inside_count_});
      for (std::size_t k = 0; k < outside_count_; ++k)
        add_piece(pixel, outside_[k]);
    } else {
      piece.next = pixel.pieces;
      pixel.pieces = piece_id;
    }
  }
  if (pixel.pieces == kNone) close(column, row, item);
}

/// What of the piece is on the positive sides of all lines, in `inside_`, and
/// the rest, in convex parts; false if that is all.
bool PixelCells::cut_piece(const Piece& piece, Pixel& pixel) {
  const auto count = static_cast<std::size_t>(piece.count);
  // A cut adds a corner at most, and the first is repeated.
  const std::size_t most = count + active_count_ + 2;
  if (values_.size() < most) {
    values_.resize(most);
    inside_.resize(most);
    kept_.resize(most);
  }
  if (outside_points_.size() < most * active_count_)
    outside_points_.resize(most * active_count_);
  copy_few(piece.corners.data(), count, inside_.data());
  inside_count_ = count;
  outside_count_ = 0;
  Point* outside = outside_points_.data();
  for (std::size_t l = 0; l < active_count_; ++l) {
    const PixelLine line = active_[l];
    Point* inside = inside_.data();
    double* values = values_.data();
    const std::size_t n = inside_count_;
    double least = 0;
    double greatest = 0;
    bool any_doubt = false;
    for (std::size_t k = 0; k < n; ++k) {
      double v = value(line, inside[k]);
      if (std::abs(v) <= tolerance_) {
        v = 0;
        any_doubt = true;
      }
      least = std::min(least, v);
      greatest = std::max(greatest, v);
      values[k] = v;
    }
    pixel.doubts += any_doubt || (least < 0 && greatest > 0) ? 1 : 0;
    if (greatest == 0) return false;
    if (least == 0) continue;
    values[n] = values[0];
    inside[n] = inside[0];
    Point* kept = kept_.data();
    Point* const first = outside;
    for (std::size_t k = 0; k < n; ++k) {
      const Point p = inside[k];
      const double here = values[k];
      const double there = values[k + 1];
      if (here >= 0) *kept++ = p;
      if (here <= 0) *outside++ = p;
      if (here * there < 0) {
        const Point q = inside[k + 1];
        const double t = here / (here - there);
        const Point middle = {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
        *kept++ = middle;
        *outside++ = middle;
      }
    }
    outside_[outside_count_++] = {first, outside};
    inside_count_ = static_cast<std::size_t>(kept - kept_.data());
    inside_.swap(kept_);
  }
  return true;
}

void PixelCells::close(std::int32_t column, std::int32_t row, PolygonId item) {
  const std::int32_t id = pixel_of_[index_of(column, row)];
  Pixel& pixel = pixels_[static_cast<std::size_t>(id)];
  while (pixel.pieces != kNone) {
    const std::int32_t piece_id = pixel.pieces;
    Piece& piece = pieces_[static_cast<std::size_t>(piece_id)];
    add_seen(pixel, item,
             {piece.corners.data(), static_cast<std::size_t>(piece.count)});
    pixel.pieces = piece.next;
    piece.next = free_piece_;
    free_piece_ = piece_id;
  }
  shares_.clear();
  while (pixel.seen != kNone) {
    const std::int32_t seen_id = pixel.seen;
    Seen& seen = seen_[static_cast<std::size_t>(seen_id)];
    shares_.push_back(seen.share);
    pixel.seen = seen.next;
    seen.next = free_seen_;
    free_seen_ = seen_id;
  }
  // A line that is off by its tolerance is less than half of that away, for its
  // value grows by at least 2 in a pixel; corners that it is said to pass are
  // as far again. It has at most sqrt 2 of its length in the pixel, so what one
  // item gets of another's area is less than 1.5 times the tolerance. Corners
  // and sums are off by less than 2^-48.
  const double error = 3 * (tolerance_ + 0x1p-48) * pixel.doubts;
  free_pixels_.push_back(id);
  mark_lit(column, row);
  sink_.mix(column, row, shares_, error);
}

void PixelCells::finish() {
  for (const Pixel& pixel : pixels_) {
    if (pixel.pieces != kNone) close(pixel.column, pixel.row, kBackground);
  }
}

bool PixelCells::any_unlit(const CellBox& box) const {
  // Boxes are in twice the image's coordinates.
  const auto at = [](double twice, double margin, std::int32_t first,
                     std::int32_t end) {
    return within(std::floor(twice / 2 + margin), first, end - 1);
  };
  const std::int32_t left = at(box.left, -kMargin, 0, width_);
  const std::int32_t right = at(box.right, kMargin, 0, width_);
  const std::int32_t top = at(box.top, -kMargin, first_row_, end_row_);
  const std::int32_t bottom = at(box.bottom, kMargin, first_row_, end_row_);
  const std::uint64_t first_mask = ~std::uint64_t{0} << (left % 64);
  const std::uint64_t last_mask = ~std::uint64_t{0} >> (63 - right % 64);
  for (std::int32_t from = top; from <= bottom;) {
    const std::int32_t block = (from - first_row_) / kBlockRows;
    const std::int32_t last =
        std::min(bottom, first_row_ + (block + 1) * kBlockRows - 1);
    for (std::int32_t word = left / 64; word <= right / 64; ++word) {
      if (block_left_[static_cast<std::size_t>(block) * words_ +
                      static_cast<std::size_t>(word)] == 0)
        continue;
      std::uint64_t mask = ~std::uint64_t{0};
      if (word == left / 64) mask &= first_mask;
      if (word == right / 64) mask &= last_mask;
      for (std::int32_t row = from; row <= last; ++row) {
        if ((unlit_[word_of(word * 64, row)] & mask) != 0) return true;
      }
    }
    from = last + 1;
  }
  return false;
}

}  // namespace halfspace::fast
