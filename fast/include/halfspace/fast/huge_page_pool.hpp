#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>

#include "halfspace/threads.hpp"

namespace halfspace::fast {

/// Memory for long lists, for programs that work on millions of faces: in huge
/// pages where the system has them, and kept when it is given back.
///
/// The system makes every page when it is first touched, which takes longer
/// than to fill it, and the processor looks up small pages one by one. A
/// program that wants this for all lists makes it the default at its start:
///
///     static auto* const pool = new halfspace::fast::HugePagePool;
///     std::pmr::set_default_resource(pool);
///
/// The library itself never does so.
/// Requires: the pool outlives what it allocated: here it is never destroyed.
/// Keeps:    blocks of 64 KiB and more, up to `most_kept` bytes in all; none
///           under the address sanitizer, which is to see their use.
/// Cost:     a lock for every long block. Safe for several threads.
class HugePagePool final : public std::pmr::memory_resource {
 public:
  explicit HugePagePool(std::size_t most_kept = std::size_t{1} << 27)
      : most_kept_(most_kept) {}
  /// Gives back what it keeps.
  ~HugePagePool() override;
  HugePagePool(const HugePagePool&) = delete;
  HugePagePool& operator=(const HugePagePool&) = delete;

 private:
  /// A block that was given back.
  struct Block {
    void* memory = nullptr;
    std::size_t bytes = 0;
  };
  static constexpr std::size_t kMostBlocks = 64;

  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* memory, std::size_t bytes,
                     std::size_t alignment) override;
  bool do_is_equal(
      const std::pmr::memory_resource& other) const noexcept override {
    return this == &other;
  }

  bool is_kept(std::size_t bytes) const;
  void* take(std::size_t bytes);
  void keep(const Block& block);
  Block removed(std::size_t i);

  std::size_t most_kept_;
  Mutex mutex_;
  std::array<Block, kMostBlocks> blocks_;  ///< the oldest first
  std::size_t count_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace halfspace::fast
