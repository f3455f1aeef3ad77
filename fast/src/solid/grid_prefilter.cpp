#include "solid/grid_prefilter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace halfspace::fast {
namespace {

/// Cells along the first axis; a row of them is a word.
constexpr std::int32_t kCells = 64;

/// Rows along y and z, chosen so that a cell holds a few faces on average.
std::int32_t row_count(std::size_t faces) {
  std::int32_t count = 8;
  while (count < kCells && 16 * static_cast<std::size_t>(count) *
                                   static_cast<std::size_t>(count) <
                               faces)
    count *= 2;
  return count;
}

/// A bitmap of cells of a box, marked where faces of one list are. Faces that
/// overlap share a cell, because rounding keeps the order of coordinates.
class PrefilterGrid {
 public:
  PrefilterGrid(const Box& reach, std::size_t faces)
      : row_count_(row_count(faces)) {
    const std::array<std::int32_t, 3> count{kCells, row_count_, row_count_};
    for (std::size_t k = 0; k < 3; ++k) {
      const float size = reach.high[k] - reach.low[k];
      low_[k] = reach.low[k];
      scale_[k] = size > 0 ? static_cast<float>(count[k]) / size : 0;
      last_[k] = static_cast<float>(count[k] - 1);
    }
  }

  /// Whether it did so: not if faces have very many cells.
  bool mark(const Solid& solid, const std::vector<std::int32_t>& faces) {
    rows_.assign(static_cast<std::size_t>(row_count_ * row_count_), 0);
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

  /// Three numbers and an unused one, for SIMD.
  using Four = float __attribute__((vector_size(16)));
  using FourCells = std::int32_t __attribute__((vector_size(16)));

  /// A NaN, from a box without extent, counts as the first cell.
  FourCells cells_of(const Four& at) const {
    const Four scaled = (at - low_) * scale_;
    const Four most = scaled < last_ ? scaled : last_;
    return __builtin_convertvector(scaled > 0 ? most : Four{}, FourCells);
  }
  Range range_of(const Face& face) const {
    const auto& [low, high] = face.box;
    const FourCells first = cells_of(Four{low[0], low[1], low[2]});
    const FourCells last = cells_of(Four{high[0], high[1], high[2]});
    return {{first[1], first[2]},
            {last[1], last[2]},
            ~std::uint64_t{0} << first[0] &
                ~std::uint64_t{0} >> (kCells - 1 - last[0])};
  }
  /// Calls `visit(row)` until it returns true. Whether it did.
  template <class Visit>
  bool for_rows(const Range& range, const Visit& visit) {
    for (std::int32_t z = range.low[1]; z <= range.high[1]; ++z) {
      for (std::int32_t y = range.low[0]; y <= range.high[0]; ++y) {
        if (visit(rows_[static_cast<std::size_t>(z * row_count_ + y)]))
          return true;
      }
    }
    return false;
  }

  std::int32_t row_count_;
  Four low_{}, scale_{}, last_{};
  std::vector<std::uint64_t> rows_;
};

}  // namespace

void grid_prefilter(const Solid& first, std::vector<std::int32_t>& of_first,
                    const Solid& second, std::vector<std::int32_t>& of_second,
                    const Box& reach) {
  constexpr std::size_t kMany = 512;
  if (std::min(of_first.size(), of_second.size()) < kMany) return;
  PrefilterGrid cells(reach, of_second.size());
  if (!cells.mark(second, of_second)) return;
  cells.filter(first, of_first);
  if (!cells.mark(first, of_first)) return;
  cells.filter(second, of_second);
}

}  // namespace halfspace::fast
