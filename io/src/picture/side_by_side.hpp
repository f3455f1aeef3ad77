#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <system_error>
#include <thread>
#include <vector>

/// A few large pieces of work in several threads, one where
/// HALFSPACE_ONE_THREAD says so.
namespace halfspace::io {

/// At least 1.
inline int machine_threads() {
#if defined(HALFSPACE_ONE_THREAD)
  return 1;
#else
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
#endif
}

/// Calls `work` with 0 to count - 1, in up to `threads` threads, of which this
/// is one; in fewer where the system gives no more. Requires: `work` throws
/// nothing.
template <class Work>
void side_by_side(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
#if !defined(HALFSPACE_ONE_THREAD)
  std::vector<std::jthread> others;
  try {
    for (std::size_t t = 1; t < static_cast<std::size_t>(threads) && t < count;
         ++t) {
      others.emplace_back(take);
    }
  } catch (const std::system_error&) {
    // Those that there are do the work.
  }
#else
  (void)threads;
#endif
  take();
}

}  // namespace halfspace::io
