#pragma once

#include <algorithm>
#include <cstddef>

#include "base/threads.hpp"
#include "base/tsan.hpp"

namespace halfspace::fast {

/// How many threads `threads` asks for: 0 for as many as the machine has.
inline int thread_count(int threads) {
  return threads > 0 ? threads : threads::default_threads();
}

/// Calls `work(block, first, last)` for blocks of `size` of the indices 0 to
/// `count` - 1, on up to `threads` threads at once. The blocks are the same for
/// any number of threads, so that results can be put in order.
/// Requires: threads >= 1.
template <class Work>
void for_blocks(int threads, std::size_t count, std::size_t size, Work&& work) {
  const std::size_t blocks = (count + size - 1) / size;
  const auto one = [&](std::size_t b) {
    work(b, b * size, std::min(count, (b + 1) * size));
  };
  if (threads <= 1 || blocks <= 1) {
    for (std::size_t b = 0; b < blocks; ++b) one(b);
    return;
  }
  const TsanForkJoin shared;
  threads::in_arena(threads, [&] {
    threads::for_each_index(
        blocks, [&](std::size_t b) { shared.task([&] { one(b); }); });
  });
}

}  // namespace halfspace::fast
