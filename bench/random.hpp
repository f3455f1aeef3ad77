#pragma once

#include <cstdint>

#include "halfspace/bsp_tree.hpp"

namespace halfspace::bench {

/// A stream of random integers that is the same on every machine: the
/// generator of S3.4, so that a seed names a workload for ever.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(mix(seed)) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15u;
    return mix(state_);
  }

  /// From `first` to `last`, both included; the bias is below 2^-32.
  /// Requires: first <= last and last - first < 2^32.
  std::int64_t between(std::int64_t first, std::int64_t last) {
    const auto count = static_cast<std::uint64_t>(last - first) + 1;
    return first + static_cast<std::int64_t>(next() % count);
  }

 private:
  std::uint64_t state_;
};

}  // namespace halfspace::bench
