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

/// What a thread has done until now is done before what another does after its
/// `take_over()` of the same token. Only told to the thread sanitizer, which
/// does not see how oneTBB begins and ends tasks: wherever these stand, oneTBB
/// orders the two itself.
inline void hand_over([[maybe_unused]] const void* token) {
#ifdef HALFSPACE_THREAD_SANITIZER
  __tsan_release(const_cast<void*>(token));
#endif
}

inline void take_over([[maybe_unused]] const void* token) {
#ifdef HALFSPACE_THREAD_SANITIZER
  __tsan_acquire(const_cast<void*>(token));
#endif
}

/// Work that several threads do, between one's beginning and end: what it did
/// before is done before theirs, and theirs before it goes on.
class SharedWork {
 public:
  SharedWork() { hand_over(&begun_); }
  ~SharedWork() { take_over(&done_); }
  SharedWork(const SharedWork&) = delete;
  SharedWork& operator=(const SharedWork&) = delete;

  /// Calls `work()`, a part of it. Never inlined: what the thread sanitizer
  /// reports within functions of oneTBB is suppressed.
  template <class Work>
  [[gnu::noinline]] void part(Work&& work) const {
    take_over(&begun_);
    work();
    hand_over(&done_);
  }

 private:
  char begun_ = 0;
  char done_ = 0;
};

}  // namespace halfspace::fast
