#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "halfspace/threads.hpp"

/// A few large pieces of work in several threads, one where
/// HALFSPACE_ONE_THREAD says so.
namespace halfspace::io {

/// Calls `work` with 0 to count - 1, in up to `threads` threads, of which this
/// is one; in fewer where the system gives no more. What `work` throws first is
/// thrown again, once no thread works any more.
template <class Work>
void side_by_side(std::size_t count, int threads, const Work& work) {
#if defined(HALFSPACE_ONE_THREAD)
  (void)threads;
  for (std::size_t i = 0; i < count; ++i) work(i);
#else
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto take = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      const std::scoped_lock lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (std::size_t t = 1;
           t < static_cast<std::size_t>(threads) && t < count; ++t) {
        others.emplace_back(take);
      }
    } catch (const std::system_error&) {
      // Those that there are do the work.
    }
    take();
  }
  if (thrown) std::rethrow_exception(thrown);
#endif
}

}  // namespace halfspace::io
