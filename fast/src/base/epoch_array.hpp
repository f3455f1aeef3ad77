#pragma once

#include <cstdint>

#include "halfspace/fast/list.hpp"

namespace halfspace::fast {

/// Values by number, few of them given, which can all be forgotten at once in
/// no time.
template <class T>
class Stamped {
 public:
  void forget() {
    if (++now_ != 0) return;
    slots_.clear();
    now_ = 1;
  }
  T get(std::int32_t number, T otherwise) const {
    const auto at = static_cast<std::size_t>(number);
    return at < slots_.size() && slots_[at].stamp == now_ ? slots_[at].value
                                                          : otherwise;
  }
  void set(std::int32_t number, T value) {
    const auto at = static_cast<std::size_t>(number);
    if (at >= slots_.size()) slots_.resize(at + 1 + at / 2);
    slots_[at] = {now_, value};
  }

 private:
  struct Slot {
    std::uint32_t stamp = 0;
    T value{};
  };
  List<Slot> slots_;
  std::uint32_t now_ = 1;
};

}  // namespace halfspace::fast
