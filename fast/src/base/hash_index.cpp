#include "base/hash_index.hpp"

#include <algorithm>
#include <bit>

#include "halfspace/assert.hpp"

namespace halfspace::fast {

void HashIndex::place(const Slot& slot) {
  const auto is_free = [this](std::size_t s) { return slots_[s].index < 0; };
  slots_[probe(slot.mark, slots_.size() - 1, is_free)] = slot;
}

void HashIndex::grow(std::size_t size) {
  List<Slot> old(size, slots_.get_allocator());
  old.swap(slots_);
  for (const Slot& slot : old) {
    if (slot.index >= 0) place(slot);
  }
}

void HashIndex::reserve(std::size_t count, std::size_t more) {
  if (2 * count > slots_.size())
    grow(std::bit_ceil(std::max<std::size_t>(16, 2 * (count + more))));
}

void HashIndex::enter(std::uint64_t hash, std::int32_t index) {
  HALFSPACE_ASSERT(index >= 0);
  if (2 * ++count_ > slots_.size())
    grow(std::max<std::size_t>(16, 2 * slots_.size()));
  place({mark_of(hash), index});
}

}  // namespace halfspace::fast
