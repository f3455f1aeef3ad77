// Included before everything in builds for WebAssembly: std::sort() in a fifth
// of the code that libc++ takes for each type of elements, which is a sixth of
// the module in all. What is sorted has a total order where the order matters,
// so results do not change.
//
// libc++'s sort() calls __sort_dispatch(); of two that fit the one with a
// constraint is taken. Should libc++ call it otherwise one day, the module is
// right and large, and the test of its size says so.
#pragma once

// CMake's own questions to the compiler have no standard.
#if __cplusplus >= 202002L

#include <__config>
#include <cstddef>

_LIBCPP_BEGIN_NAMESPACE_STD

template <class Policy, class Iterator, class Less>
requires true
constexpr void __sort_dispatch(Iterator first, Iterator last, Less& less);

_LIBCPP_END_NAMESPACE_STD

#include <algorithm>
#include <utility>

namespace halfspace::wasm {

template <class Iterator, class Less>
constexpr void insertion_sort(Iterator first, Iterator last, Less& less) {
  for (Iterator next = first; next != last; ++next) {
    auto value = std::move(*next);
    Iterator to = next;
    for (; to != first && less(value, *(to - 1)); --to)
      *to = std::move(*(to - 1));
    *to = std::move(value);
  }
}

/// Quicksort (Hoare 1962) by pivots at places that have nothing to do with what
/// is sorted: n log n on average; the recursion is log n deep.
template <class Iterator, class Less>
constexpr void quicksort(Iterator first, Iterator last, Less& less) {
  constexpr std::ptrdiff_t kFew = 12;
  while (last - first > kFew) {
    const auto count = static_cast<std::size_t>(last - first);
    // A step of a linear congruential generator, whose high bits are good.
    const std::size_t random = (count * 1'664'525u + 1'013'904'223u) >> 8;
    std::iter_swap(first, first + static_cast<std::ptrdiff_t>(random % count));
    Iterator i = first, j = last;
    for (;;) {
      do ++i;
      while (i != last && less(*i, *first));
      do --j;
      while (less(*first, *j));
      if (!(i < j)) break;
      std::iter_swap(i, j);
    }
    std::iter_swap(first, j);
    if (j - first < last - j) {
      wasm::quicksort(first, j, less);
      first = j + 1;
    } else {
      wasm::quicksort(j + 1, last, less);
      last = j;
    }
  }
  wasm::insertion_sort(first, last, less);
}

}  // namespace halfspace::wasm

_LIBCPP_BEGIN_NAMESPACE_STD

template <class Policy, class Iterator, class Less>
requires true
constexpr void __sort_dispatch(Iterator first, Iterator last, Less& less) {
  halfspace::wasm::quicksort(first, last, less);
}

_LIBCPP_END_NAMESPACE_STD

#endif
