#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "halfspace/assert.hpp"

namespace halfspace::io {

/// Spreads the bits of `z` over all of it.
constexpr std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 32)) * 0x9e3779b97f4a7c15u;
  return z ^ (z >> 29);
}

/// Finds equal points among those of a vector: a hash table of indices, open
/// addressing, at most half full.
template <class Point, class Hash>
class PointTable {
 public:
  /// Makes room for so many points.
  void reserve(std::size_t count) {
    HALFSPACE_ASSERT(slots_.empty());
    slots_.assign(std::bit_ceil(2 * count + 2), kFree);
  }
  /// The index of the point in `points`, where it is added if it is new.
  std::int32_t index_of(Point point, std::vector<Point>& points) {
    if (2 * (points.size() + 1) > slots_.size()) grow(points);
    std::size_t slot = first_slot(point);
    while (slots_[slot] != kFree) {
      if (points[static_cast<std::size_t>(slots_[slot])] == point) {
        return slots_[slot];
      }
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = static_cast<std::int32_t>(points.size());
    points.push_back(std::move(point));
    return slots_[slot];
  }

 private:
  static constexpr std::int32_t kFree = -1;

  std::size_t first_slot(const Point& point) const {
    return Hash{}(point) & (slots_.size() - 1);
  }

  void grow(const std::vector<Point>& points) {
    const std::size_t size = slots_.empty() ? 64 : 2 * slots_.size();
    slots_.assign(size, kFree);
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::size_t slot = first_slot(points[i]);
      while (slots_[slot] != kFree) slot = (slot + 1) & (size - 1);
      slots_[slot] = static_cast<std::int32_t>(i);
    }
  }

  std::vector<std::int32_t> slots_;
};

}  // namespace halfspace::io
