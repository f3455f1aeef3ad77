#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/fast/list.hpp"

namespace halfspace::fast {

/// Values by index, few of which are set; clear() takes constant time. A value
/// counts only if it was set in the present epoch.
///
/// Requires: indices are not negative.
template <class T>
class EpochArray {
 public:
  void clear() {
    if (++epoch_ != 0) return;
    slots_.clear();
    epoch_ = 1;
  }
  T get(std::int32_t index, T otherwise) const {
    const auto at = static_cast<std::size_t>(index);
    return at < slots_.size() && slots_[at].epoch == epoch_ ? slots_[at].value
                                                            : otherwise;
  }
  void set(std::int32_t index, T value) {
    const auto at = static_cast<std::size_t>(index);
    if (at >= slots_.size()) slots_.resize(at + 1 + at / 2);
    slots_[at] = {epoch_, value};
  }

 private:
  struct Slot {
    std::uint32_t epoch = 0;
    T value{};
  };
  List<Slot> slots_;
  std::uint32_t epoch_ = 1;
};

}  // namespace halfspace::fast
