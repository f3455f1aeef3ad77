#include "halfspace/fast/list.hpp"

#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace halfspace::fast {
namespace {

/// The usual size of large pages.
constexpr std::size_t kPage = std::size_t{1} << 21;
constexpr std::align_val_t kAligned{kPage};
/// Shorter lists come from memory that has been in use before, mostly.
constexpr std::size_t kLong = 4 * kPage;

}  // namespace

void* allocate_list(std::size_t bytes) {
  if (bytes < kLong) return ::operator new(bytes);
  void* const memory = ::operator new(bytes, kAligned);
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  // What it answers makes no difference: it is advice. The rest is too short.
  static_cast<void>(madvise(memory, bytes / kPage * kPage, MADV_HUGEPAGE));
#endif
  return memory;
}

void free_list(void* memory, std::size_t bytes) noexcept {
  if (bytes < kLong) {
    ::operator delete(memory);
  } else {
    ::operator delete(memory, kAligned);
  }
}

}  // namespace halfspace::fast
