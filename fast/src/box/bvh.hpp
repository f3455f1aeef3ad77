#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "box/box.hpp"
#include "halfspace/fast/list.hpp"

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
  Box box(std::size_t i) const {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = low_[k][i / 4][i % 4];
      box.high[k] = high_[k][i / 4][i % 4];
    }
    return box;
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
    List<Item> row;
    row.reserve(items.size());
    for (const std::int32_t item : items) row.push_back({box_of(item), item});
    build(row);
  }

  /// Calls `found(item)` for the items whose boxes overlap `box`.
  template <class Found>
  void find(const Box& box, Found&& found) const {
    visit_packets(box, 0, [&](std::size_t packet) {
      std::uint32_t rest = eights_[packet].overlapping(box);
      for (; rest != 0; rest &= rest - 1) found(item(packet, rest));
    });
  }

  /// The number of packets: items stand in eights that are near each other.
  std::size_t packet_count() const {
    return level_count_ > 1 ? levels_[1] : level_count_;
  }

  /// Calls `visit(item)` for the items of a packet; of none, if there are less.
  template <class Visit>
  void for_items(std::size_t packet, Visit&& visit) const {
    const std::size_t first = EightBoxes::kCount * packet;
    const std::size_t end =
        std::min(first + EightBoxes::kCount, numbers_.size());
    for (std::size_t i = first; i < end; ++i) visit(numbers_[i]);
  }

  /// Calls `found(item, other)` once for each two items whose boxes overlap,
  /// one of which is in the packet and the other one in the same or a later
  /// one. A search for eight items takes little longer than for one.
  template <class Found>
  void find_pairs(std::size_t packet, Found&& found) const {
    const EightBoxes& own = eights_[packet];
    visit_packets(own.hull(), packet, [&](std::size_t other) {
      std::uint32_t those =
          other == packet
              ? 0xff
              : own.overlapping(
                    eights_[levels_[1] + other / EightBoxes::kCount].box(
                        other % EightBoxes::kCount));
      for (; those != 0; those &= those - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(those));
        std::uint32_t rest = eights_[other].overlapping(own.box(i));
        if (other == packet) rest &= ~std::uint32_t{1} << i;
        for (; rest != 0; rest &= rest - 1)
          found(item(packet, those), item(other, rest));
      }
    });
  }

 private:
  struct Item {
    Box box;
    std::int32_t number = 0;
  };
  /// 8^11 exceeds the number of items that an int32 counts.
  static constexpr std::size_t kMostLevels = 11;

  /// The item of a packet that the lowest bit stands for.
  std::int32_t item(std::size_t packet, std::uint32_t bits) const {
    return numbers_[EightBoxes::kCount * packet +
                    static_cast<std::size_t>(std::countr_zero(bits))];
  }

  /// Calls `visit(packet)` for the packets from number `from` on whose hulls
  /// overlap `box`.
  template <class Visit>
  void visit_packets(const Box& box, std::size_t from, Visit&& visit) const {
    if (level_count_ < 2) {
      if (level_count_ != 0) visit(std::size_t{0});
      return;
    }
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
      // The last packet below it.
      if ((((at + 1) << (3 * (level - 1))) - 1) < from) continue;
      if (level == 1) {
        visit(at);
        continue;
      }
      --level;
      path[level] = {EightBoxes::kCount * at,
                     eights_[levels_[level] + at].overlapping(box)};
    }
  }

  static void sort_items(List<Item>& items);
  void build(List<Item>& items);

  List<std::int32_t> numbers_;  ///< the items'
  /// The items' boxes, then the hulls of eight of them, and so on.
  List<EightBoxes> eights_;
  std::array<std::size_t, kMostLevels> levels_{};  ///< where each begins
  std::size_t level_count_ = 0;
};

}  // namespace halfspace::fast
