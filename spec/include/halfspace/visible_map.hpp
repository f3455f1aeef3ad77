#pragma once

#include <cstdint>
#include <vector>

namespace halfspace {

/// The key of the background, and of what is outside of the image (S7.3).
constexpr std::int32_t kBackgroundKey = -1;
constexpr std::int32_t kOutsideKey = -2;

/// What a visible map depends on, beside scene and camera (S7.1, S7.3).
struct MapOptions {
  bool cull = false;  ///< as ImageOptions::cull
  /// One key a polygon, not negative; empty: its id.
  std::vector<std::int32_t> keys;
};

}  // namespace halfspace
