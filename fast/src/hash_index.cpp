#include "hash_index.hpp"

#include <algorithm>

namespace halfspace::fast {

void HashIndex::place(const Slot& slot) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t s = slot.hash & mask;
  while (slots_[s].index >= 0) s = (s + 1) & mask;
  slots_[s] = slot;
}

void HashIndex::enter(std::uint64_t hash, std::int32_t index) {
  if (2 * ++count_ > slots_.size()) {
    std::vector<Slot> old(std::max<std::size_t>(16, 2 * slots_.size()));
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.index >= 0) place(slot);
    }
  }
  place({hash, index});
}

}  // namespace halfspace::fast
