#include "halfspace/fast/list.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <mutex>
#include <new>

#include "base/sanitizer.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace halfspace::fast {
namespace {

/// The usual size of large pages.
constexpr std::size_t kPage = std::size_t{1} << 21;
constexpr std::align_val_t kAligned{kPage};
/// From here on memory is in large pages, and in whole ones.
constexpr std::size_t kLong = kPage / 2;

void* allocate(std::size_t bytes) {
  if (bytes < kLong) return ::operator new(bytes);
  void* const memory = ::operator new(bytes, kAligned);
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  // What it answers makes no difference: it is advice. The rest is too short.
  static_cast<void>(madvise(memory, bytes / kPage * kPage, MADV_HUGEPAGE));
#endif
  return memory;
}

void release(void* memory, std::size_t bytes) noexcept {
  if (bytes < kLong) {
    ::operator delete(memory);
  } else {
    ::operator delete(memory, kAligned);
  }
}

/// Memory that lists have given back, for the next ones: the system makes each
/// page anew, which takes longer than to fill it.
class Spare {
 public:
  /// Memory of just that size, or nothing.
  void* take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    // What was given back last is most likely at hand.
    for (std::size_t i = count_; i-- > 0;) {
      if (blocks_[i].bytes == bytes) return removed(i).memory;
    }
    return nullptr;
  }
  /// What has been here longest makes room.
  void give(void* memory, std::size_t bytes) noexcept {
    const std::lock_guard lock(mutex_);
    while (count_ > 0 && (count_ == kMostBlocks || bytes_ + bytes > kMost)) {
      const Block oldest = removed(0);
      release(oldest.memory, oldest.bytes);
    }
    blocks_[count_++] = {memory, bytes};
    bytes_ += bytes;
  }

  /// No more is kept in all.
  static constexpr std::size_t kMost = std::size_t{1} << 27;

 private:
  struct Block {
    void* memory = nullptr;
    std::size_t bytes = 0;
  };
  static constexpr std::size_t kMostBlocks = 64;

  Block removed(std::size_t i) {
    const Block block = blocks_[i];
    std::copy(blocks_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
              blocks_.begin() + static_cast<std::ptrdiff_t>(count_),
              blocks_.begin() + static_cast<std::ptrdiff_t>(i));
    --count_;
    bytes_ -= block.bytes;
    return block;
  }

  std::mutex mutex_;
  std::array<Block, kMostBlocks> blocks_;
  std::size_t count_ = 0;
  std::size_t bytes_ = 0;
};

/// Never destroyed: lists may outlive whatever is static.
Spare& spare() {
  static Spare* const instance = new Spare;
  return *instance;
}

/// What is shorter is left to the allocator, which keeps it, too. Sanitizers
/// are to see what is used after it was given back.
bool is_kept(std::size_t bytes) {
  constexpr std::size_t kShort = std::size_t{1} << 16;
  return !kSanitized && bytes >= kShort && bytes <= Spare::kMost / 2;
}

/// Few sizes, so that what is given back fits: eight for each power of two, or
/// fewer where large pages are too large for that.
std::size_t block_size(std::size_t bytes) {
  const std::size_t eighth = std::bit_floor(bytes) / 8;
  const std::size_t step = bytes < kLong ? eighth : std::max(eighth, kPage);
  return (bytes + step - 1) / step * step;
}

}  // namespace

void* allocate_list(std::size_t bytes) {
  if (!is_kept(bytes)) return allocate(bytes);
  const std::size_t size = block_size(bytes);
  void* const memory = spare().take(size);
  return memory != nullptr ? memory : allocate(size);
}

void free_list(void* memory, std::size_t bytes) noexcept {
  if (is_kept(bytes)) {
    spare().give(memory, block_size(bytes));
  } else {
    release(memory, bytes);
  }
}

}  // namespace halfspace::fast
