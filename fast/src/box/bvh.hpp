#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "box/box.hpp"

namespace halfspace::fast {

inline bool overlap(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

/// Eight boxes in structure-of-arrays form, compared with another one at once.
/// Boxes that are not set overlap none.
class EightBoxes {
 public:
  static constexpr std::size_t kCount = 8;

  EightBoxes() {
    // Beyond every float that a box may have.
    for (auto& lows : low_) lows.fill(Four{} + kBeyond);
    for (auto& highs : high_) highs.fill(Four{} - kBeyond);
  }
  void set(std::size_t i, const Box& box) {
    for (std::size_t k = 0; k < 3; ++k) {
      low_[k][i / 4][i % 4] = box.low[k];
      high_[k][i / 4][i % 4] = box.high[k];
    }
  }
  /// Holds all of them.
  Box hull() const {
    Box box = kEmptyBox;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < kCount; ++i) {
        box.low[k] = std::min(box.low[k], low_[k][i / 4][i % 4]);
        box.high[k] = std::max(box.high[k], high_[k][i / 4][i % 4]);
      }
    }
    return box;
  }
  /// A bit for each that overlaps `box`.
  std::uint32_t overlapping(const Box& box) const {
    const auto among = [&](std::size_t half) {
      FourBits all = {-1, -1, -1, -1};
      for (std::size_t k = 0; k < 3; ++k) {
        all &= (low_[k][half] <= box.high[k]) & (high_[k][half] >= box.low[k]);
      }
      return all;
    };
    const FourBits bits = (among(0) & FourBits{1, 2, 4, 8}) |
                          (among(1) & FourBits{16, 32, 64, 128});
    return static_cast<std::uint32_t>(bits[0] | bits[1] | bits[2] | bits[3]);
  }

 private:
  using Four = float __attribute__((vector_size(16)));
  using FourBits = std::int32_t __attribute__((vector_size(16)));
  static constexpr float kBeyond = std::numeric_limits<float>::infinity();

  std::array<std::array<Four, 2>, 3> low_, high_;
};

/// A bounding volume hierarchy of boxes with eight children a node, to find
/// those that overlap another box.
class BoxTree {
 public:
  /// Holds the boxes `box_of(item)`, for the numbers in `items`.
  template <class BoxOf>
  BoxTree(BoxOf&& box_of, const std::vector<std::int32_t>& items) {
    std::vector<Item> row;
    row.reserve(items.size());
    for (const std::int32_t item : items) row.push_back({box_of(item), item});
    build(row);
  }

  /// Calls `found(item)` for the items whose boxes overlap `box`.
  template <class Found>
  void find(const Box& box, Found&& found) const {
    if (level_count_ == 0) return;
    // At each level the children of one node that are still to be visited.
    struct Pending {
      std::size_t first;
      std::uint32_t rest;
    };
    std::array<Pending, kMostLevels> path;
    std::size_t level = level_count_ - 1;
    path[level] = {0, eights_[levels_[level]].overlapping(box)};
    while (true) {
      Pending& pending = path[level];
      if (pending.rest == 0) {
        if (++level == level_count_) return;
        continue;
      }
      const std::size_t at =
          pending.first +
          static_cast<std::size_t>(std::countr_zero(pending.rest));
      pending.rest &= pending.rest - 1;
      if (level == 0) {
        found(numbers_[at]);
        continue;
      }
      --level;
      path[level] = {EightBoxes::kCount * at,
                     eights_[levels_[level] + at].overlapping(box)};
    }
  }

 private:
  struct Item {
    Box box;
    std::int32_t number = 0;
  };
  /// 8^11 exceeds the number of items that an int32 counts.
  static constexpr std::size_t kMostLevels = 11;

  static void sort_items(std::vector<Item>& items);
  void build(std::vector<Item>& items);

  std::vector<std::int32_t> numbers_;  ///< the items'
  /// The items' boxes, then the hulls of eight of them, and so on.
  std::vector<EightBoxes> eights_;
  std::array<std::size_t, kMostLevels> levels_{};  ///< where each begins
  std::size_t level_count_ = 0;
};

}  // namespace halfspace::fast
