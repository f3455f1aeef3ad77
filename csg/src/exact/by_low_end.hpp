#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace halfspace::csg {

/// Sorts what is mostly two to six entries, without a buffer. Equal ones stay
/// in their order.
template <class At, class Less>
void sort_few(At first, At last, Less&& less) {
  constexpr std::ptrdiff_t kFew = 16;
  if (last - first > kFew) {
    std::stable_sort(first, last, less);
    return;
  }
  for (At i = first; i != last; ++i) {
    const auto moved = *i;
    At at = i;
    for (; at != first && less(moved, *(at - 1)); --at) *at = *(at - 1);
    *at = moved;
  }
}

/// Sorts uses of edges by their lesser ends, `low_of(use)`, and those of one
/// end, which are few, by `less`. Equal ones stay in their order.
/// Requires: lesser ends are from 0 to `ends` - 1.
/// Cost:     linear where no end has many edges.
template <class Use, class LowOf, class Less>
void sort_by_low_end(std::vector<Use>& uses, std::size_t ends, LowOf&& low_of,
                     Less&& less) {
  std::vector<std::uint32_t> at(ends + 1);
  for (const Use& use : uses) ++at[static_cast<std::size_t>(low_of(use)) + 1];
  std::partial_sum(at.begin(), at.end(), at.begin());
  std::vector<Use> sorted(uses.size());
  for (const Use& use : uses)
    sorted[at[static_cast<std::size_t>(low_of(use))]++] = use;
  // Each is where the next end's begin now.
  auto first = sorted.begin();
  for (std::size_t end = 0; end < ends; ++end) {
    const auto last = sorted.begin() + at[end];
    sort_few(first, last, less);
    first = last;
  }
  uses = std::move(sorted);
}

}  // namespace halfspace::csg
