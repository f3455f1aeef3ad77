#pragma once

#include <cstdint>

#include "halfspace/fast/render.hpp"

namespace halfspace::fast {

/// The image of the scene by the painter's algorithm: back to front, later over
/// earlier (S5.5). In a leaf each pixel has an order of its own: by depth
/// (S5.3).
///
/// Cost:     every polygon in the image; of memory, for a thread, 3 MiB of what
///           leaves cover, and some 500 bytes for each polygon of a leaf in a
///           tile.
Rendering paint(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& image, const RenderOptions& options = {});

/// The same into a rendering that is there: no memory is asked for where the
/// sizes agree.
void paint(const Scene& scene, const BspTree& tree, const Camera& camera,
           const ImageOptions& image, const RenderOptions& options,
           Rendering& result);

/// The same image with every polygon as transparent as `alpha` says (S5.6): 0
/// is not seen at all, 255 hides what is behind.
///
/// Its items are paint()'s: the polygons in front.
/// Exact:    yes: integers, in the order of S5.6, whatever the number of
///           threads.
/// Cost:     that of paint().
Rendering blend(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& image, std::uint8_t alpha,
                const RenderOptions& options = {});

}  // namespace halfspace::fast
