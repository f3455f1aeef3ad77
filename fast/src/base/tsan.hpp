#pragma once

#if defined(__SANITIZE_THREAD__)
#define HALFSPACE_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define HALFSPACE_THREAD_SANITIZER
#endif
#endif

#ifdef HALFSPACE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace halfspace::fast {

/// Happens-before annotations for the thread sanitizer, which does not see how
/// oneTBB orders the beginning and end of tasks. Without it they do nothing.
///
/// All that a thread did before tsan_release(token) happens before all that
/// another thread does after tsan_acquire(token).
inline void tsan_release([[maybe_unused]] const void* token) {
#ifdef HALFSPACE_THREAD_SANITIZER
  __tsan_release(const_cast<void*>(token));
#endif
}

inline void tsan_acquire([[maybe_unused]] const void* token) {
#ifdef HALFSPACE_THREAD_SANITIZER
  __tsan_acquire(const_cast<void*>(token));
#endif
}

/// Annotates a fork and join: what the owner did before it made this happens
/// before every task, and every task before the destructor returns.
class TsanForkJoin {
 public:
  TsanForkJoin() { tsan_release(&fork_); }
  ~TsanForkJoin() { tsan_acquire(&join_); }
  TsanForkJoin(const TsanForkJoin&) = delete;
  TsanForkJoin& operator=(const TsanForkJoin&) = delete;

  /// Calls `work()` as one of the tasks. Never inlined: what the thread
  /// sanitizer reports within functions of oneTBB is suppressed.
  template <class Work>
  [[gnu::noinline]] void task(Work&& work) const {
    tsan_acquire(&fork_);
    work();
    tsan_release(&join_);
  }

 private:
  char fork_ = 0;
  char join_ = 0;
};

}  // namespace halfspace::fast
