#include "box_tree.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace halfspace::fast {
namespace {

constexpr std::int32_t kLeafSize = 4;

/// So many bits of each coordinate make an item's key.
constexpr int kKeyBits = 16;
/// Sorting digit by digit, where there are enough items for that.
constexpr int kDigitBits = 12;
constexpr std::size_t kMany = 2048;

struct Key {
  std::uint64_t key;
  std::uint32_t item;
};

/// The bits of a 16-bit number with two zeros before each.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 16) & 0x0000ff0000ff;
  v = (v | v << 8) & 0x00f00f00f00f;
  v = (v | v << 4) & 0x0c30c30c30c3;
  v = (v | v << 2) & 0x249249249249;
  return v;
}

void sort_keys(std::vector<Key>& keys) {
  if (keys.size() < kMany) {
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
      return a.key != b.key ? a.key < b.key : a.item < b.item;
    });
    return;
  }
  std::vector<Key> sorted(keys.size());
  for (int shift = 0; shift < 3 * kKeyBits; shift += kDigitBits) {
    std::vector<std::uint32_t> place((1u << kDigitBits) + 1);
    const auto digit = [shift](const Key& key) {
      return key.key >> shift & ((1u << kDigitBits) - 1);
    };
    for (const Key& key : keys) ++place[digit(key) + 1];
    for (std::size_t d = 1; d < place.size(); ++d) place[d] += place[d - 1];
    for (const Key& key : keys) sorted[place[digit(key)]++] = key;
    keys.swap(sorted);
  }
}

/// A part of the items that is to become the subtree of `node`.
struct ItemRange {
  std::int32_t begin;
  std::int32_t end;
  std::int32_t node;
};

}  // namespace

/// Along a curve that fills space, so that what is near each other in the row
/// is so in space.
void BoxTree::sort_items() {
  std::array<float, 3> low = kEmptyBox.low;
  std::array<float, 3> high = kEmptyBox.high;
  const auto middle = [](const Box& box, std::size_t k) {
    return box.low[k] / 2 + box.high[k] / 2;
  };
  for (const Item& item : items_) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], middle(item.box, k));
      high[k] = std::max(high[k], middle(item.box, k));
    }
  }
  float size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, high[k] - low[k]);
  constexpr float kMost = (1 << kKeyBits) - 1;
  const float scale = size > 0 ? kMost / size : 0;
  std::vector<Key> keys(items_.size());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    keys[i] = {0, static_cast<std::uint32_t>(i)};
    for (std::size_t k = 0; k < 3; ++k) {
      const float at = (middle(items_[i].box, k) - low[k]) * scale;
      keys[i].key |= spread(static_cast<std::uint64_t>(std::min(at, kMost)))
                     << k;
    }
  }
  sort_keys(keys);
  std::vector<Item> sorted;
  sorted.reserve(items_.size());
  for (const Key& key : keys) sorted.push_back(items_[key.item]);
  items_.swap(sorted);
}

void BoxTree::build() {
  if (items_.empty()) return;
  sort_items();
  // Step 1: halves of halves.
  nodes_.emplace_back();
  std::vector<ItemRange> tasks{
      {0, static_cast<std::int32_t>(items_.size()), 0}};
  while (!tasks.empty()) {
    const ItemRange task = tasks.back();
    tasks.pop_back();
    Node& node = nodes_[static_cast<std::size_t>(task.node)];
    node.first = task.begin;
    node.count = task.end - task.begin;
    if (node.count <= kLeafSize) continue;
    const std::int32_t half = task.begin + node.count / 2;
    const auto child = static_cast<std::int32_t>(nodes_.size());
    node.first = child;
    node.second = child + 1;
    tasks.push_back({half, task.end, child + 1});
    tasks.push_back({task.begin, half, child});
    nodes_.resize(nodes_.size() + 2);
  }
  // Step 2: the boxes, children before their parents.
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    node->box = kEmptyBox;
    if (node->second >= 0) {
      extend(node->box, nodes_[static_cast<std::size_t>(node->first)].box);
      extend(node->box, nodes_[static_cast<std::size_t>(node->second)].box);
      continue;
    }
    for (std::int32_t i = 0; i < node->count; ++i)
      extend(node->box, items_[static_cast<std::size_t>(node->first + i)].box);
  }
}

}  // namespace halfspace::fast
