#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

namespace halfspace::fast::one_thread {

/// What base/threads_tbb.hpp does, in the one thread that there is: the same
/// names and the same meaning, for systems without threads.

inline int default_threads() { return 1; }

template <class Work>
void in_arena(int, Work&& work) {
  work();
}

template <class Index, class Work>
void for_each_index(Index count, const Work& work) {
  for (Index i{}; i < count; ++i) work(i);
}

template <class Index, class Work>
void for_each_task(Index count, const Work& work) {
  for_each_index(count, work);
}

template <class Work>
void for_ranges(std::size_t count, std::size_t size, const Work& work) {
  for (std::size_t first = 0; first < count; first += size)
    work(first, size < count - first ? first + size : count);
}

/// Tasks in a queue: a task may add others however deep, and the stack does not
/// grow.
class TaskGroup {
 public:
  template <class Work>
  void run(Work&& work) {
    tasks_.emplace_back(std::forward<Work>(work));
  }
  void wait() {
    while (!tasks_.empty()) {
      const std::function<void()> task = std::move(tasks_.front());
      tasks_.pop_front();
      task();
    }
  }

 private:
  std::deque<std::function<void()>> tasks_;
};

template <class T>
class PerThread {
 public:
  template <class Make>
  explicit PerThread(Make make) : make_(std::move(make)) {}
  T& local() {
    if (!value_) value_.emplace(make_());
    return *value_;
  }

 private:
  std::function<T()> make_;
  std::optional<T> value_;
};

}  // namespace halfspace::fast::one_thread
