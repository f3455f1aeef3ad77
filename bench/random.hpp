#pragma once

#include <cstdint>

#include "halfspace/splitmix.hpp"

namespace halfspace::bench {

/// A stream of random integers that is the same on every machine: the
/// generator of S3.4, so that a seed names a workload for ever.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(mix(seed) + kSplitMixStep) {}

  std::uint64_t next() { return generator_.next(); }

  /// From `first` to `last`, both included; the bias is below 2^-32.
  /// Requires: first <= last and last - first < 2^32.
  std::int64_t between(std::int64_t first, std::int64_t last) {
    const auto count = static_cast<std::uint64_t>(last - first) + 1;
    return first + static_cast<std::int64_t>(next() % count);
  }

 private:
  SplitMix64 generator_;
};

}  // namespace halfspace::bench
