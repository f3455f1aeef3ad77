#pragma once

#include <cstdint>

#include "base/sanitizer.hpp"

namespace halfspace::fast {

/// How many of a test's cases run: all in the optimised build, a quarter under
/// sanitizers, where each takes ten times as long.
constexpr std::uint64_t cases(std::uint64_t all) {
  return kSanitized ? all / 4 : all;
}

}  // namespace halfspace::fast
