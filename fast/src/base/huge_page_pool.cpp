#include "halfspace/fast/huge_page_pool.hpp"

#include <algorithm>
#include <bit>
#include <new>

#include "base/sanitizer.hpp"
#include "halfspace/assert.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace halfspace::fast {
namespace {

/// The usual size of huge pages.
constexpr std::size_t kPage = std::size_t{1} << 21;
constexpr std::align_val_t kAligned{kPage};
/// From here on memory is in huge pages. Untuned.
constexpr std::size_t kLong = kPage / 2;
/// Shorter blocks are left to new and delete, which keep them, too. Untuned.
constexpr std::size_t kShort = std::size_t{1} << 16;

void* allocate_block(std::size_t bytes) {
  if (bytes < kLong) return ::operator new(bytes);
  void* const memory = ::operator new(bytes, kAligned);
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  // Advice: it does not matter whether the system takes it. The part of a page
  // at the end is too short for one.
  static_cast<void>(madvise(memory, bytes / kPage * kPage, MADV_HUGEPAGE));
#endif
  return memory;
}

void free_block(void* memory, std::size_t bytes) noexcept {
  if (bytes < kLong) {
    ::operator delete(memory);
  } else {
    ::operator delete(memory, kAligned);
  }
}

/// Few sizes, so that kept blocks fit new requests: eight for each power of
/// two, or fewer where huge pages are too large for that.
std::size_t block_size(std::size_t bytes) {
  const std::size_t eighth = std::bit_floor(bytes) / 8;
  const std::size_t step = bytes < kLong ? eighth : std::max(eighth, kPage);
  return (bytes + step - 1) / step * step;
}

}  // namespace

HugePagePool::~HugePagePool() {
  while (count_ > 0) {
    const Block block = removed(count_ - 1);
    free_block(block.memory, block.bytes);
  }
}

void* HugePagePool::do_allocate(std::size_t bytes, std::size_t alignment) {
  if (alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__)
    return ::operator new (bytes, std::align_val_t{alignment});
  if (!is_kept(bytes)) return allocate_block(bytes);
  const std::size_t size = block_size(bytes);
  void* const memory = take(size);
  return memory != nullptr ? memory : allocate_block(size);
}

void HugePagePool::do_deallocate(void* memory, std::size_t bytes,
                                 std::size_t alignment) {
  if (alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__) {
    ::operator delete (memory, std::align_val_t{alignment});
  } else if (is_kept(bytes)) {
    keep({memory, block_size(bytes)});
  } else {
    free_block(memory, bytes);
  }
}

/// Whether blocks of that size are kept. Longer ones would push out all others.
bool HugePagePool::is_kept(std::size_t bytes) const {
  return !kSanitized && bytes >= kShort && bytes <= most_kept_ / 2;
}

/// A block of just that size, or nothing.
void* HugePagePool::take(std::size_t bytes) {
  const Lock lock(mutex_);
  // The block that was given back last is most likely in the cache.
  for (std::size_t i = count_; i-- > 0;) {
    if (blocks_[i].bytes == bytes) return removed(i).memory;
  }
  return nullptr;
}

/// The oldest blocks make room.
void HugePagePool::keep(const Block& block) {
  const Lock lock(mutex_);
  while (count_ > 0 &&
         (count_ == kMostBlocks || bytes_ + block.bytes > most_kept_)) {
    const Block oldest = removed(0);
    free_block(oldest.memory, oldest.bytes);
  }
  HALFSPACE_ASSERT(count_ < kMostBlocks);
  blocks_[count_++] = block;
  bytes_ += block.bytes;
}

HugePagePool::Block HugePagePool::removed(std::size_t i) {
  HALFSPACE_ASSERT(i < count_);
  const Block block = blocks_[i];
  std::copy(blocks_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
            blocks_.begin() + static_cast<std::ptrdiff_t>(count_),
            blocks_.begin() + static_cast<std::ptrdiff_t>(i));
  --count_;
  bytes_ -= block.bytes;
  return block;
}

}  // namespace halfspace::fast
