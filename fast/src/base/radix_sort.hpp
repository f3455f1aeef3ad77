#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "halfspace/fast/list.hpp"

namespace halfspace::fast {

/// What is to be sorted, by a key.
struct Keyed {
  std::uint64_t key;
  std::uint32_t item;
};

/// Sorts by key; what has one key stays in its order.
///
/// Requires: items ascend.
/// Cost: linear, with a pass for each digit in which keys differ.
inline void sort_by_key(List<Keyed>& keyed) {
  constexpr int kDigitBits = 11;
  constexpr std::size_t kMany = 256;
  if (keyed.size() < kMany) {
    std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
      return a.key != b.key ? a.key < b.key : a.item < b.item;
    });
    return;
  }
  std::uint64_t differs = 0;
  for (const Keyed& k : keyed) differs |= k.key ^ keyed.front().key;
  List<Keyed> sorted(keyed.size());
  for (std::uint64_t left = differs; left != 0;) {
    // The next digit begins with a bit in which keys differ.
    const int shift = std::countr_zero(left);
    constexpr std::uint64_t kMask = (1u << kDigitBits) - 1;
    left &= ~(kMask << shift);
    std::array<std::uint32_t, kMask + 2> place{};
    for (const Keyed& k : keyed) ++place[(k.key >> shift & kMask) + 1];
    for (std::size_t d = 1; d < place.size(); ++d) place[d] += place[d - 1];
    for (const Keyed& k : keyed) sorted[place[k.key >> shift & kMask]++] = k;
    keyed.swap(sorted);
  }
}

/// A key in whose order numbers are, -0 before 0.
/// Requires: it is a number.
inline std::uint64_t key_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

}  // namespace halfspace::fast
