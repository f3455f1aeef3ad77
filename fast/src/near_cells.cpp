#include "near_cells.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace halfspace::fast {
namespace {

/// So many cells along the first side; a row of them is a word.
constexpr std::int32_t kCells = 64;

/// So many rows along the others: of so many faces of a surface some cover a
/// cell, which is few.
std::int32_t row_count(std::size_t faces) {
  std::int32_t count = 8;
  while (count < kCells && 16 * static_cast<std::size_t>(count) *
                                   static_cast<std::size_t>(count) <
                               faces)
    count *= 2;
  return count;
}

/// The faces of a list that are to be dropped are told in cells of a box: which
/// cells have faces of the other list. What overlaps has a cell in common, for
/// rounding keeps the order of coordinates.
class NearCells {
 public:
  NearCells(const Box& reach, std::size_t faces) : low_(reach.low) {
    const std::int32_t rows = row_count(faces);
    count_ = {kCells, rows, rows};
    for (std::size_t k = 0; k < 3; ++k) {
      const float size = reach.high[k] - reach.low[k];
      scale_[k] = size > 0 ? static_cast<float>(count_[k]) / size : 0;
    }
  }

  /// Whether it did so: not if faces have very many cells.
  bool mark(const Solid& solid, const std::vector<std::int32_t>& faces) {
    rows_.assign(static_cast<std::size_t>(count_[1] * count_[2]), 0);
    std::size_t budget = kRowsPerFace * faces.size();
    for (const std::int32_t f : faces) {
      const Range range = range_of(solid.faces[static_cast<std::size_t>(f)]);
      if (range.row_count() > budget) return false;
      budget -= range.row_count();
      for_rows(range, [&](std::uint64_t& row) {
        row |= range.bits;
        return false;
      });
    }
    return true;
  }

  /// Keeps the faces that have a marked cell.
  void filter(const Solid& solid, std::vector<std::int32_t>& faces) {
    std::size_t kept = 0;
    for (const std::int32_t f : faces) {
      const Range range = range_of(solid.faces[static_cast<std::size_t>(f)]);
      // Cells of what is large are not looked at one by one.
      const bool is_kept = range.row_count() > kRowsPerFace ||
                           for_rows(range, [&](std::uint64_t row) {
                             return (row & range.bits) != 0;
                           });
      if (is_kept) faces[kept++] = f;
    }
    faces.resize(kept);
  }

 private:
  static constexpr std::size_t kRowsPerFace = 64;

  struct Range {
    std::array<std::int32_t, 2> low;
    std::array<std::int32_t, 2> high;
    std::uint64_t bits;  ///< along the first axis
    std::size_t row_count() const {
      return static_cast<std::size_t>(high[0] - low[0] + 1) *
             static_cast<std::size_t>(high[1] - low[1] + 1);
    }
  };

  /// What is not a number counts as the first cell: where the box is flat.
  std::int32_t cell(float coordinate, std::size_t k) const {
    const auto last = static_cast<float>(count_[k] - 1);
    const float at = (coordinate - low_[k]) * scale_[k];
    return static_cast<std::int32_t>(at > 0 ? (at < last ? at : last) : 0);
  }
  Range range_of(const Face& face) const {
    Range range;
    for (std::size_t k = 0; k < 2; ++k) {
      range.low[k] = cell(face.box.low[k + 1], k + 1);
      range.high[k] = cell(face.box.high[k + 1], k + 1);
    }
    const std::int32_t first = cell(face.box.low[0], 0);
    const std::int32_t last = cell(face.box.high[0], 0);
    range.bits =
        ~std::uint64_t{0} << first & ~std::uint64_t{0} >> (kCells - 1 - last);
    return range;
  }
  /// Calls `visit(row)` until it returns true. Whether it did.
  template <class Visit>
  bool for_rows(const Range& range, const Visit& visit) {
    for (std::int32_t z = range.low[1]; z <= range.high[1]; ++z) {
      for (std::int32_t y = range.low[0]; y <= range.high[0]; ++y) {
        if (visit(rows_[static_cast<std::size_t>(z * count_[1] + y)]))
          return true;
      }
    }
    return false;
  }

  std::array<std::int32_t, 3> count_;
  std::array<float, 3> low_;
  std::array<float, 3> scale_;
  std::vector<std::uint64_t> rows_;
};

}  // namespace

void drop_lonely(const Solid& first, std::vector<std::int32_t>& of_first,
                 const Solid& second, std::vector<std::int32_t>& of_second,
                 const Box& reach) {
  constexpr std::size_t kMany = 512;
  if (std::min(of_first.size(), of_second.size()) < kMany) return;
  NearCells cells(reach, of_second.size());
  if (!cells.mark(second, of_second)) return;
  cells.filter(first, of_first);
  if (!cells.mark(first, of_first)) return;
  cells.filter(second, of_second);
}

}  // namespace halfspace::fast
