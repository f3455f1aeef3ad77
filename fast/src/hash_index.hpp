#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

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
    for (std::size_t s = hash & mask; slots_[s].index >= 0;
         s = (s + 1) & mask) {
      if (slots_[s].hash == hash && equal(slots_[s].index))
        return slots_[s].index;
    }
    return -1;
  }
  void enter(std::uint64_t hash, std::int32_t index);

 private:
  struct Slot {
    std::uint64_t hash = 0;
    std::int32_t index = -1;
  };
  void place(const Slot& slot);

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace halfspace::fast
