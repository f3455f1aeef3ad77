#pragma once

#include <cstddef>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// An image of exact areas, and what it took.
struct AreaImage {
  ColorImage colors;
  /// Pixels of which a channel was so near a step of rounding that rationals
  /// decided it.
  std::size_t exact_pixels = 0;
};

/// The image in which a pixel's colour is the integral over what is seen in it
/// (S7.6, S10.5).
///
/// From front to back polygons are cut out of what is unlit of the pixels that
/// their edges pass; those that one covers are filled.
/// `threads`: as RenderOptions::threads.
/// Requires: a tree of this scene; a closed scene where there are caps.
/// Exact:    yes: areas in doubles with a bound; where that touches a step of
///           rounding, the visible map of the pixel in rationals.
///           The same for any number of threads.
/// Cost:     that of pixels, and the pixels that edges of what is seen pass.
AreaImage render_area(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& image,
                      int threads = 1);

}  // namespace halfspace::fast
