#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// A part of space between planes across axes: along each, coordinates from
/// `low` up to `high`. What lies in a plane belongs to its positive side.
/// Units: grid steps.
struct CellRegion {
  static constexpr std::int64_t kNoLow =
      std::numeric_limits<std::int64_t>::min();
  static constexpr std::int64_t kNoHigh =
      std::numeric_limits<std::int64_t>::max();
  std::array<std::int64_t, 3> low = {kNoLow, kNoLow, kNoLow};
  std::array<std::int64_t, 3> high = {kNoHigh, kNoHigh, kNoHigh};
};

/// A box of the grid, its faces included.
struct GridRange {
  std::array<std::int64_t, 3> low{};
  std::array<std::int64_t, 3> high{};
};

/// The box of a polygon. Exact.
GridRange range_of(const Scene& scene, PolygonId polygon);

/// The least box of floats that holds the range.
Box box_of(const GridRange& range);

/// A region, and the polygons of which a part may be in it, by their boxes.
struct CellList {
  CellRegion region;
  GridRange range;                  ///< holds what of them is in the region
  std::vector<PolygonId> polygons;  ///< in id order
};

/// A tree of planes across axes whose leaves are regions, and have no
/// fragments.
struct DividedCells {
  BspTree tree;                            ///< with boxes
  std::vector<std::int32_t> cell_of_node;  ///< -1 where it is no leaf
  std::vector<CellList> cells;             ///< two at least
};

/// Divides a list into cells of about `cell_size` polygons: a grid counts where
/// polygons are, planes at its borders are chosen by the surface area heuristic
/// from the counts alone, and each polygon goes to the cells that its box
/// reaches. No polygon is cut. Nothing, where polygons do not part, or are so
/// large that cells would name more than `most_named` in all.
///
/// Exact: yes: of a polygon each part is in one region, and that names it.
/// Cost:  two passes over the polygons, in `threads` threads; the same result
///        for any number.
std::optional<DividedCells> divide_into_cells(const Scene& scene,
                                              const CellList& list,
                                              std::size_t cell_size,
                                              std::size_t most_named,
                                              int threads);

}  // namespace halfspace::fast
