#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/epoch_array.hpp"

namespace halfspace::fast {

/// Parents of the elements 0 to `count` - 1, for DisjointSets.
class DenseParents {
 public:
  explicit DenseParents(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }
  std::int32_t get(std::int32_t i) const {
    return parents_[static_cast<std::size_t>(i)];
  }
  void set(std::int32_t i, std::int32_t parent) {
    parents_[static_cast<std::size_t>(i)] = parent;
  }

 private:
  std::vector<std::int32_t> parents_;
};

/// Parents of any elements that are not negative, each its own parent until
/// set; clear() takes constant time.
class SparseParents {
 public:
  std::int32_t get(std::int32_t i) const { return parents_.get(i, i); }
  void set(std::int32_t i, std::int32_t parent) { parents_.set(i, parent); }
  /// The parent if one was set, else `otherwise`.
  std::int32_t get(std::int32_t i, std::int32_t otherwise) const {
    return parents_.get(i, otherwise);
  }
  void clear() { parents_.clear(); }

 private:
  EpochArray<std::int32_t> parents_;
};

/// Disjoint sets of integers: union-find with path halving (TAR75). Every set
/// is known by its root.
///
/// Cost: O(log n) an operation, amortised: sets are not united by rank, so
///       that unite() can keep the least element as the root.
template <class Parents>
class BasicDisjointSets {
 public:
  BasicDisjointSets() = default;
  explicit BasicDisjointSets(std::size_t count) : parents_(count) {}

  Parents& parents() { return parents_; }
  const Parents& parents() const { return parents_; }

  std::int32_t root(std::int32_t i) {
    while (true) {
      const std::int32_t up = parents_.get(i);
      const std::int32_t next = parents_.get(up);
      if (next == up) return up;
      parents_.set(i, next);
      i = next;
    }
  }
  /// Unites the sets of two elements; the lesser of their roots, which is that
  /// of both then.
  std::int32_t unite(std::int32_t i, std::int32_t j) {
    return unite_roots(root(i), root(j));
  }
  /// The same for elements that are roots.
  std::int32_t unite_roots(std::int32_t r, std::int32_t s) {
    const std::int32_t least = std::min(r, s);
    if (r != s) parents_.set(std::max(r, s), least);
    return least;
  }
  /// Unites the set of the root `below` with that of the root `above`, which
  /// is that of both then.
  void attach(std::int32_t below, std::int32_t above) {
    parents_.set(below, above);
  }

 private:
  Parents parents_;
};

using DisjointSets = BasicDisjointSets<DenseParents>;
using SparseDisjointSets = BasicDisjointSets<SparseParents>;

}  // namespace halfspace::fast
