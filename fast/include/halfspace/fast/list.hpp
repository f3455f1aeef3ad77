#pragma once

#include <cstddef>
#include <vector>

namespace halfspace::fast {

/// Memory for a list: that of long ones in pages as large as the system has,
/// where it can be asked for them. Pages are made one by one when first
/// touched, and looked up where they are not at hand, which takes much of the
/// time of what works on millions of faces. So what lists give back is kept for
/// the next ones, of any thread: up to 128 MiB in all.
void* allocate_list(std::size_t bytes);
void free_list(void* memory, std::size_t bytes) noexcept;

template <class T>
struct ListAllocator {
  using value_type = T;
  static_assert(alignof(T) <= alignof(std::max_align_t));

  ListAllocator() = default;
  template <class Other>
  ListAllocator(const ListAllocator<Other>&) noexcept {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(allocate_list(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    free_list(memory, count * sizeof(T));
  }
  friend bool operator==(const ListAllocator&, const ListAllocator&) {
    return true;
  }
};

/// A vector that may be long.
template <class T>
using List = std::vector<T, ListAllocator<T>>;

}  // namespace halfspace::fast
