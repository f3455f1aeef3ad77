#pragma once

#include <algorithm>
#include <utility>

#include "halfspace/fast/solid.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// The solid with its points and planes in the lease's table.
/// Requires: that table's grid has no fewer bits.
/// Threads:  any, as other threads extend the solid's own table.
Solid moved_to(const Solid& solid, TableLease& lease);

/// The bits of the grid that the solid's table is for; the least there is for
/// an empty solid without a table.
inline int grid_bits_of(const Solid& solid) {
  return solid.table ? solid.table->grid_bits() : 26;
}

/// A lease of the solid's table, or while another thread has that, of one for
/// the same grid.
inline TableLease lease_beside(const Solid& solid) {
  if (solid.table) {
    if (auto lease = TableLease::of(solid.table)) return std::move(*lease);
  }
  return TableLease::of_new(grid_bits_of(solid));
}

/// `work(solid, lease)` with a lease of the solid's table; while another thread
/// has that, with the same solid in a table of its own.
template <class Work>
auto with_lease(const Solid& solid, const Work& work) {
  if (solid.table) {
    if (auto lease = TableLease::of(solid.table)) return work(solid, *lease);
  }
  TableLease lease = TableLease::of_new(grid_bits_of(solid));
  return work(moved_to(solid, lease), lease);
}

/// The same for two solids, in one table.
template <class Work>
auto with_lease(const Solid& a, const Solid& b, const Work& work) {
  if (a.table && a.table == b.table) {
    if (auto lease = TableLease::of(a.table)) return work(a, b, *lease);
  }
  TableLease lease =
      TableLease::of_new(std::max(grid_bits_of(a), grid_bits_of(b)));
  return work(moved_to(a, lease), moved_to(b, lease), lease);
}

}  // namespace halfspace::fast
