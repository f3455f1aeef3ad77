#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/fast/list.hpp"

namespace halfspace::fast {

/// A table from hashes to indices, with open addresses. What the indices mean,
/// and when two of them are equal, is its user's affair.
class HashIndex {
 public:
  /// The index for which `equal(index)` holds among those entered with `hash`,
  /// or -1.
  template <class Equal>
  std::int32_t find(std::uint64_t hash, Equal&& equal) const {
    if (slots_.empty()) return -1;
    const std::size_t mask = slots_.size() - 1;
    const std::uint32_t mark = mark_of(hash);
    for (std::size_t s = mark & mask; slots_[s].index >= 0;
         s = (s + 1) & mask) {
      if (slots_[s].mark == mark && equal(slots_[s].index))
        return slots_[s].index;
    }
    return -1;
  }
  void enter(std::uint64_t hash, std::int32_t index);
  /// Begins to fetch what find() will look at first.
  void prefetch(std::uint64_t hash) const {
    if (!slots_.empty())
      __builtin_prefetch(&slots_[mark_of(hash) & (slots_.size() - 1)]);
  }
  /// Makes room for so many in all; and for `more`, if there was too little.
  void reserve(std::size_t count, std::size_t more);

 private:
  /// A part of the hash is enough to tell nearly all that are not equal.
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
