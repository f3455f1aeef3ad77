#pragma once

#include <cstdint>

#include "halfspace/fast/render.hpp"
#include "raster/caps.hpp"

namespace halfspace::fast {

enum class Order : std::uint8_t { kFrontToBack, kBackToFront };

/// In which order a tree is displayed, what of a polygon is not seen through,
/// how many samples a pixel has each way, and the caps' changes where those of
/// all rows are known.
struct Pass {
  Order order = Order::kFrontToBack;
  std::uint8_t alpha = kOpaque;
  int samples = 1;
  const CapChanges* caps = nullptr;
};

/// Displays a tree. The images, and a rectangle, are of samples.
void run(const Scene& scene, const BspTree& tree, const Camera& camera,
         const ImageOptions& image, const RenderOptions& options, Pass pass,
         Rendering& result);

}  // namespace halfspace::fast
