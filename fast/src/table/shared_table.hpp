#pragma once

#include <any>
#include <atomic>
#include <memory>
#include <optional>
#include <utility>

#include "table/geometry_table.hpp"

namespace halfspace::fast {

/// A geometry table that solids share.
///
/// The table only grows, so whoever knows a plane or a point may read it at any
/// time. One TableLease at a time extends it; an operation that finds it leased
/// works in a table of its own.
class SharedTable final : public GeometryTable {
 public:
  using GeometryTable::GeometryTable;

 private:
  friend class TableLease;
  std::atomic<bool> is_leased_{false};
  std::any scratch_;  ///< the lease holder's
};

/// The right to extend a shared table, and scratch memory that lasts from one
/// lease to the next: arrays by vertex would cost a small operation more than
/// its work if each made them anew.
class TableLease {
 public:
  /// Nothing while another lease of the table lasts.
  static std::optional<TableLease> of(
      const std::shared_ptr<const SharedTable>& shared) {
    // Every table is made as SharedTable, not const; the lease is what makes
    // writing to it right.
    auto table = std::const_pointer_cast<SharedTable>(shared);
    if (table->is_leased_.exchange(true, std::memory_order_acquire))
      return std::nullopt;
    return TableLease(std::move(table));
  }
  /// A lease of a new table.
  static TableLease of_new(int grid_bits) {
    return *of(std::make_shared<SharedTable>(grid_bits));
  }

  TableLease(TableLease&& other) noexcept = default;
  TableLease& operator=(TableLease&& other) noexcept {
    std::swap(table_, other.table_);
    return *this;
  }
  ~TableLease() {
    if (table_) table_->is_leased_.store(false, std::memory_order_release);
  }

  GeometryTable& table() { return *table_; }
  std::shared_ptr<const SharedTable> shared() const { return table_; }
  /// As the last lease left it, if that asked for the same type.
  template <class Scratch>
  Scratch& scratch() {
    if (std::any_cast<Scratch>(&table_->scratch_) == nullptr)
      table_->scratch_ = Scratch();
    return *std::any_cast<Scratch>(&table_->scratch_);
  }

 private:
  explicit TableLease(std::shared_ptr<SharedTable> table)
      : table_(std::move(table)) {}

  std::shared_ptr<SharedTable> table_;
};

}  // namespace halfspace::fast
