#include "box/bvh.hpp"

#include <algorithm>
#include <cstdint>

#include "base/radix_sort.hpp"
#include "halfspace/assert.hpp"

namespace halfspace::fast {
namespace {

/// An item's key holds this many bits of each coordinate. Untuned.
constexpr int kKeyBits = 10;

/// Up to this number items are taken in the order given, in which those of
/// meshes are near each other: looking at all of their packets takes no longer
/// than sorting them. Untuned.
constexpr std::size_t kFewItems = 256;

/// A 10-bit number with two zeros before each bit.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 16) & 0x030000ff;
  v = (v | v << 8) & 0x0300f00f;
  v = (v | v << 4) & 0x030c30c3;
  v = (v | v << 2) & 0x09249249;
  return v;
}

}  // namespace

/// Sorts along the Z-order curve (MOR66), so that items near each other in the
/// row are near each other in space.
void BoxTree::sort_items(List<Item>& items) {
  std::array<float, 3> low = kEmptyBox.low;
  std::array<float, 3> high = kEmptyBox.high;
  const auto middle = [](const Box& box, std::size_t k) {
    return box.low[k] / 2 + box.high[k] / 2;
  };
  for (const Item& item : items) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], middle(item.box, k));
      high[k] = std::max(high[k], middle(item.box, k));
    }
  }
  float size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, high[k] - low[k]);
  constexpr float kMost = (1 << kKeyBits) - 1;
  const float scale = size > 0 ? kMost / size : 0;
  List<KeyedIndex> keyed;
  keyed.reserve(items.size());
  for (const Item& item : items) {
    std::uint64_t key = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const float at = (middle(item.box, k) - low[k]) * scale;
      key |= spread(static_cast<std::uint32_t>(std::min(at, kMost))) << k;
    }
    keyed.push_back({key, static_cast<std::uint32_t>(keyed.size())});
  }
  sort_by_key(keyed);
  List<Item> sorted;
  sorted.reserve(items.size());
  for (const KeyedIndex& k : keyed) sorted.push_back(items[k.index]);
  items.swap(sorted);
}

void BoxTree::build(List<Item>& items) {
  if (items.empty()) return;
  if (items.size() > kFewItems) sort_items(items);
  constexpr std::size_t kCount = EightBoxes::kCount;
  const auto eights_of = [](std::size_t n) {
    return (n + kCount - 1) / kCount;
  };
  // Step 1: the items.
  numbers_.reserve(items.size());
  eights_.resize(eights_of(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i) {
    numbers_.push_back(items[i].number);
    eights_[i / kCount].set(i % kCount, items[i].box);
  }
  // Step 2: each level's eights, until there is just one.
  level_count_ = 1;
  for (std::size_t first = 0; eights_.size() - first > 1;) {
    const std::size_t below = eights_.size();
    HALFSPACE_ASSERT(level_count_ < kMostLevels);
    levels_[level_count_++] = below;
    eights_.resize(below + eights_of(below - first));
    for (std::size_t i = first; i < below; ++i) {
      eights_[below + (i - first) / kCount].set((i - first) % kCount,
                                                eights_[i].hull());
    }
    first = below;
  }
}

}  // namespace halfspace::fast
