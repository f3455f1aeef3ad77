#pragma once

#include <cstdint>

namespace halfspace {

/// The increment of splitmix64: 2^64 divided by the golden ratio, odd.
constexpr std::uint64_t kSplitMixStep = 0x9e3779b97f4a7c15u;

/// The number that splitmix64 gives in state `z` (SLF14). A bijection.
constexpr std::uint64_t mix(std::uint64_t z) {
  z += kSplitMixStep;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// The generator splitmix64 (SLF14): the same numbers on every machine.
class SplitMix64 {
 public:
  explicit constexpr SplitMix64(std::uint64_t state) : state_(state) {}
  constexpr std::uint64_t next() {
    const std::uint64_t number = mix(state_);
    state_ += kSplitMixStep;
    return number;
  }

 private:
  std::uint64_t state_;
};

}  // namespace halfspace
