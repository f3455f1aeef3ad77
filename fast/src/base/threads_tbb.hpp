#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <cstddef>

namespace halfspace::fast::tbb_threads {

/// How many threads work by default.
inline int default_threads() {
  return oneapi::tbb::info::default_concurrency();
}

/// Calls `work()` where up to `threads` threads take part in what it starts;
/// 0: as many as there are by default.
template <class Work>
void in_arena(int threads, Work&& work) {
  // An arena keeps memory until a worker has looked at it, and a program that
  // starts thousands of them in a second is faster than that: all threads are
  // those that the caller has. It takes up no other task while it waits.
  if (threads == 0 || threads >= default_threads()) {
    oneapi::tbb::this_task_arena::isolate([&] { work(); });
    return;
  }
  oneapi::tbb::task_arena arena(threads);
  arena.execute([&] { work(); });
}

/// Calls `work(i)` for 0 <= i < count, at once and in any order.
template <class Index, class Work>
void for_each_index(Index count, const Work& work) {
  oneapi::tbb::parallel_for(Index{}, count, work);
}

/// The same for indices that are long tasks: each may go to a thread of its
/// own.
template <class Index, class Work>
void for_each_task(Index count, const Work& work) {
  oneapi::tbb::parallel_for(Index{}, count, work,
                            oneapi::tbb::simple_partitioner{});
}

/// Calls `work(first, end)` for ranges that make up 0 to `count`. Those of up
/// to `size` are not divided.
template <class Work>
void for_ranges(std::size_t count, std::size_t size, const Work& work) {
  using Range = oneapi::tbb::blocked_range<std::size_t>;
  oneapi::tbb::parallel_for(Range(0, count, size), [&](const Range& range) {
    work(range.begin(), range.end());
  });
}

/// Tasks, which may add others: run(work), wait().
using TaskGroup = oneapi::tbb::task_group;

/// A value for each thread that asks for one, made then: local().
template <class T>
using PerThread = oneapi::tbb::enumerable_thread_specific<T>;

}  // namespace halfspace::fast::tbb_threads
