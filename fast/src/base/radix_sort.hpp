#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "halfspace/assert.hpp"
#include "halfspace/fast/list.hpp"

namespace halfspace::fast {

/// Sorts by `key_of(item)`, an unsigned integer; items of one key stay in
/// their order. Radix sort from the lowest digit on (KNU98 sec. 5.2.5).
///
/// Cost: linear, with a pass for each digit in which keys differ.
template <class T, class KeyOf>
void radix_sort(List<T>& items, KeyOf&& key_of) {
  // A table of 2^11 counts fits the first-level cache. Untuned.
  constexpr int kDigitBits = 11;
  constexpr std::uint64_t kMask = (1u << kDigitBits) - 1;
  HALFSPACE_ASSERT(items.size() <= std::numeric_limits<std::uint32_t>::max());
  if (items.empty()) return;
  std::uint64_t differs = 0;
  const std::uint64_t first = key_of(items.front());
  for (const T& item : items) differs |= key_of(item) ^ first;
  List<T> sorted(items.size(), items.get_allocator());
  for (std::uint64_t left = differs; left != 0;) {
    // The next digit begins with a bit in which keys differ.
    const int shift = std::countr_zero(left);
    left &= ~(kMask << shift);
    const auto digit = [&](const T& item) {
      return static_cast<std::size_t>(key_of(item) >> shift & kMask);
    };
    std::array<std::uint32_t, kMask + 2> begin{};
    for (const T& item : items) ++begin[digit(item) + 1];
    for (std::size_t d = 1; d < begin.size(); ++d) begin[d] += begin[d - 1];
    for (const T& item : items) sorted[begin[digit(item)]++] = item;
    items.swap(sorted);
  }
}

/// An item's index in some array, and the key by which it is sorted.
struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
};

/// Sorts by key, and by index where keys are equal.
/// Requires: indices ascend.
inline void sort_by_key(List<KeyedIndex>& row) {
  constexpr std::size_t kMany = 256;  // untuned
  if (row.size() >= kMany) {
    radix_sort(row, [](const KeyedIndex& k) { return k.key; });
    return;
  }
  std::sort(row.begin(), row.end(),
            [](const KeyedIndex& a, const KeyedIndex& b) {
              return a.key != b.key ? a.key < b.key : a.index < b.index;
            });
}

/// Sorts by key, and those of one key by `before`.
template <class Before>
void sort_by_key(List<KeyedIndex>& row, Before&& before) {
  sort_by_key(row);
  for (auto at = row.begin(); at != row.end();) {
    const auto end = std::find_if(
        at, row.end(), [&](const KeyedIndex& k) { return k.key != at->key; });
    if (end - at > 1) std::sort(at, end, before);
    at = end;
  }
}

/// A key that orders integers as they are.
inline std::uint64_t key_of(std::int64_t value) {
  return static_cast<std::uint64_t>(value) ^ std::uint64_t{1} << 63;
}

/// A key that orders numbers as they are, -0 before 0.
/// Requires: `value` is not NaN.
inline std::uint64_t key_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

}  // namespace halfspace::fast
