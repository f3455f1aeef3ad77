#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/fast/visible_map.hpp"

namespace halfspace::fast {

/// The part of an arc in one pixel, as the pixel's key on its side of greater x
/// gains it and the other key loses it. Units: pixels, from the pixel's left
/// top corner.
struct ArcPiece {
  std::int32_t column = 0;
  std::int32_t gains = 0;  ///< regions, or -1
  std::int32_t loses = 0;
  double rise = 0;    ///< the integral of dy: a multiple of 2^-44
  double rise_y = 0;  ///< the integral of y dy
  double area = 0;    ///< between it and the pixel's right side
  double area_x = 0;  ///< the integral of x over that
  double area_y = 0;  ///< the integral of y over that
};

/// The pieces of all arcs of a map, row by row, in each from left to right.
struct ArcPieces {
  std::vector<std::size_t> first;  ///< of each row, and the end
  std::vector<ArcPiece> pieces;
  std::size_t most = 0;  ///< pieces of one pixel
};

ArcPieces cut_along_pixels(const VisibleMap& map, std::int32_t width,
                           std::int32_t height);

}  // namespace halfspace::fast
