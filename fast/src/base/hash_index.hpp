#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/fast/list.hpp"

namespace halfspace::fast {

/// The first slot from `start` on, cyclically, for which `stops(slot)` holds:
/// linear probing (KNU98 sec. 6.4, algorithm L).
///
/// Requires: 2^k slots, `mask` being 2^k - 1; some slot stops.
template <class Stops>
std::size_t probe(std::size_t start, std::size_t mask, Stops&& stops) {
  std::size_t slot = start & mask;
  while (!stops(slot)) slot = (slot + 1) & mask;
  return slot;
}

/// A hash table of indices, with open addressing. Its user knows what the
/// indices mean and when two entries are equal.
class HashIndex {
 public:
  /// The index for which `equal(index)` holds among those entered with `hash`,
  /// or -1.
  template <class Equal>
  std::int32_t find(std::uint64_t hash, Equal&& equal) const {
    if (slots_.empty()) return -1;
    const std::uint32_t mark = mark_of(hash);
    return slots_[probe(mark, slots_.size() - 1,
                        [&](std::size_t s) {
                          const Slot& slot = slots_[s];
                          return slot.index < 0 ||
                                 (slot.mark == mark && equal(slot.index));
                        })]
        .index;
  }
  void enter(std::uint64_t hash, std::int32_t index);
  /// By index below `count`: what enter() keeps of its hash.
  /// Requires: each index was entered once.
  List<std::uint32_t> marks(std::size_t count) const {
    List<std::uint32_t> marks(count);
    for (const Slot& slot : slots_) {
      if (slot.index >= 0)
        marks[static_cast<std::size_t>(slot.index)] = slot.mark;
    }
    return marks;
  }
  /// Begins to fetch the slot that find() reads first.
  void prefetch(std::uint64_t hash) const {
    if (!slots_.empty())
      __builtin_prefetch(&slots_[mark_of(hash) & (slots_.size() - 1)]);
  }
  /// Makes room for `count` entries in all; where there was too little, also
  /// for `more` beyond them.
  void reserve(std::size_t count, std::size_t more);

 private:
  /// Half of the hash distinguishes nearly all entries that are not equal.
  struct Slot {
    std::uint32_t mark = 0;
    std::int32_t index = -1;
  };
  static std::uint32_t mark_of(std::uint64_t hash) {
    return static_cast<std::uint32_t>(hash);
  }
  void grow(std::size_t size);
  void place(const Slot& slot);

  List<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace halfspace::fast
