#pragma once

/// What the libraries take from a system with threads, apart from oneTBB
/// (fast/src/base/threads.hpp). HALFSPACE_THREADS=OFF, as for WebAssembly,
/// defines HALFSPACE_ONE_THREAD: then nothing here asks the system.
#if !defined(HALFSPACE_ONE_THREAD)
#include <mutex>
#include <thread>
#endif

namespace halfspace {

#if defined(HALFSPACE_ONE_THREAD)

/// Nobody else could hold it.
class Mutex {
 public:
  void lock() {}
  void unlock() {}
};

/// Holds mutexes to the end of the block.
template <class... Mutexes>
class Lock {
 public:
  explicit Lock(Mutexes&...) {}
  ~Lock() {}  // so that a lock that nobody looks at is not unused
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
};

/// How many threads the machine has; at least 1.
inline int machine_threads() { return 1; }

#else

using Mutex = std::mutex;

template <class... Mutexes>
class Lock : std::scoped_lock<Mutexes...> {
 public:
  explicit Lock(Mutexes&... mutexes)
      : std::scoped_lock<Mutexes...>(mutexes...) {}
};

inline int machine_threads() {
  const unsigned count = std::thread::hardware_concurrency();
  return count == 0 ? 1 : static_cast<int>(count);
}

#endif

}  // namespace halfspace
