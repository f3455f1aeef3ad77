#pragma once

#include <cstdint>

namespace halfspace {

/// What keeps the unlit part of the image (S4.9).
enum class ScreenKind : std::uint8_t {
  kList,  ///< F2B's lists of unlit segments, one a line
  kBsp1,  ///< a 1-D BSP tree a line
  kQuad,  ///< a quadtree
  kBsp2   ///< a 2-D BSP tree whose splitters are the images of edges
};

}  // namespace halfspace
