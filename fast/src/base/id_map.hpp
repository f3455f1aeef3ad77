#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace halfspace::fast {

/// The least and the greatest of some numbers, and how many they were.
struct Extent {
  std::int32_t low = std::numeric_limits<std::int32_t>::max();
  std::int32_t high = -1;
  std::size_t uses = 0;

  void add(std::int32_t number) {
    low = std::min(low, number);
    high = std::max(high, number);
    ++uses;
  }
  bool is_dense() const {
    return uses > 0 && static_cast<std::size_t>(high - low) < 8 * uses;
  }
};

/// Tells most numbers that are not among some others, by their last digits.
class Sieve {
 public:
  explicit Sieve(std::size_t count)
      : digits_(std::bit_ceil(8 * count + 1) - 1), may_(digits_ + 1) {}
  void add(std::int32_t number) { may_[place(number)] = 1; }
  /// Never false for one of them.
  bool may_hold(std::int32_t number) const { return may_[place(number)] != 0; }

 private:
  std::size_t place(std::int32_t number) const {
    return static_cast<std::size_t>(number) & digits_;
  }

  std::size_t digits_;
  std::vector<std::uint8_t> may_;
};

/// Places in a list for numbers, which are not negative: a list that is not
/// much longer than the numbers are many, however large they are.
class Places {
 public:
  explicit Places(const Extent& extent) {
    if (extent.is_dense()) {
      low_ = extent.low;
      size_ = static_cast<std::size_t>(extent.high - extent.low) + 1;
    } else {
      size_ = std::bit_ceil(2 * extent.uses + 1);
      keys_.assign(size_, -1);
    }
  }
  std::size_t size() const { return size_; }
  /// Calls `work` with what gives numbers their places, for work that asks for
  /// so many that it should not ask each time which kind of list this is.
  template <class Work>
  void with_places(const Work& work) {
    if (keys_.empty()) {
      work([low = low_](std::int32_t number) {
        return static_cast<std::size_t>(number - low);
      });
    } else {
      work([this](std::int32_t number) { return (*this)(number); });
    }
  }

  /// The place of one of the numbers that make up the extent.
  std::size_t operator()(std::int32_t number) {
    if (keys_.empty()) return static_cast<std::size_t>(number - low_);
    const std::size_t at = probe(number);
    keys_[at] = number;
    return at;
  }
  /// Likewise; for one that has been given no place yet, any that is free.
  std::size_t find(std::int32_t number) const {
    return keys_.empty() ? static_cast<std::size_t>(number - low_)
                         : probe(number);
  }
  /// The number that was given a place, or may be; -1 if there is none.
  std::int32_t number_at(std::size_t place) const {
    return keys_.empty() ? low_ + static_cast<std::int32_t>(place)
                         : keys_[place];
  }
  /// Whether the number is one that number_at() gives.
  bool holds(std::int32_t number) const {
    return keys_.empty() ? number >= low_ &&
                               static_cast<std::size_t>(number - low_) < size_
                         : keys_[probe(number)] == number;
  }

 private:
  /// Numbers stand in rows, nearly. A few apart they are near each other, and
  /// leave room between them at which a search for another one ends.
  std::size_t probe(std::int32_t number) const {
    const std::size_t mask = size_ - 1;
    std::size_t at = 5 * static_cast<std::size_t>(number) & mask;
    while (keys_[at] >= 0 && keys_[at] != number) at = (at + 1) & mask;
    return at;
  }

  std::int32_t low_ = 0;
  std::size_t size_ = 0;
  std::vector<std::int32_t> keys_;
};

}  // namespace halfspace::fast
