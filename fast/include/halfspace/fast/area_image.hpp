#pragma once

#include <cstddef>

#include "halfspace/fast/visible_map.hpp"
#include "halfspace/image.hpp"

namespace halfspace::fast {

/// An image of exact areas, and what it took.
struct AreaImage {
  ColorImage colors;
  std::size_t cells = 0;  ///< of the map
  std::size_t arcs = 0;
  /// Pixels of which a channel was so near a step of rounding that rationals
  /// decided it.
  std::size_t exact_pixels = 0;
};

/// The image in which a pixel's colour is the integral over what is seen in it
/// (S7.6, S10.5): from the visible map, whose arcs are cut along pixels and
/// added up from left to right (signed trapezoids and prefix sums).
///
/// Requires: a tree of this scene without leaves (divide_leaves()); a closed
///           scene where there are caps.
/// Exact:    yes: sums in doubles with a bound, rationals where that touches a
///           step of rounding.
/// Errors:   kOutOfRange: more cells than the limit; says how many.
/// Cost:     that of the map, and the pixels that its arcs pass.
Result<AreaImage> render_area(const Scene& scene, const BspTree& tree,
                              const Camera& camera, const ImageOptions& image,
                              const MapLimits& limits = {});

}  // namespace halfspace::fast
