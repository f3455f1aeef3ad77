#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "halfspace/fast/list.hpp"

namespace halfspace::fast {

/// A list that one thread at a time extends while others read what was in it
/// when they got to know of it.
///
/// An element does not change once others know of it. When the list outgrows
/// its memory the old memory is kept until the list ends, for others may still
/// read there: at most as much again as the list takes.
template <class T>
class AppendList {
 public:
  AppendList() = default;
  AppendList(const AppendList&) = delete;
  AppendList& operator=(const AppendList&) = delete;

  /// Any thread. Requires: the element is known to the thread.
  const T& operator[](std::size_t i) const {
    return data_.load(std::memory_order_acquire)[i];
  }

  /// From here on: only the thread that extends the list.
  std::size_t size() const { return items_.size(); }
  std::size_t capacity() const { return items_.capacity(); }
  const T& back() const { return items_.back(); }
  T& emplace_back() {
    make_room(1);
    return items_.emplace_back();
  }
  void push_back(const T& item) {
    make_room(1);
    items_.push_back(item);
  }
  template <class Range>
  void append(const Range& range) {
    make_room(range.size());
    items_.insert(items_.end(), range.begin(), range.end());
  }
  void reserve(std::size_t capacity) {
    if (capacity <= items_.capacity()) return;
    List<T> larger;
    larger.reserve(capacity);
    larger.insert(larger.end(), items_.begin(), items_.end());
    items_.swap(larger);
    data_.store(items_.data(), std::memory_order_release);
    if (!larger.empty()) outgrown_.push_back(std::move(larger));
  }

 private:
  void make_room(std::size_t more) {
    const std::size_t size = items_.size() + more;
    if (size > items_.capacity())
      reserve(std::max({size, 2 * items_.capacity(), std::size_t{16}}));
  }

  List<T> items_;
  std::vector<List<T>> outgrown_;
  std::atomic<const T*> data_{nullptr};
};

}  // namespace halfspace::fast
