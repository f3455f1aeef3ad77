#pragma once

#include "halfspace/assert.hpp"

namespace halfspace::fast {

/// Whether builds check what one room takes for granted of another. Those for
/// finding faults do (presets dev, asan, tsan, fuzz and campaign).
#ifdef NDEBUG
inline constexpr bool kChecksSeams = false;
#else
inline constexpr bool kChecksSeams = true;
#endif

}  // namespace halfspace::fast

/// Stops the program where a condition at a seam between two rooms is broken:
/// a bug of this library. Costs nothing in an optimised build, so it may ask
/// for exact signs. Stands in pairs: what must hold, and what must not.
#define HALFSPACE_CHECK(condition)                                    \
  do {                                                                \
    if (::halfspace::fast::kChecksSeams) HALFSPACE_ASSERT(condition); \
  } while (false)
