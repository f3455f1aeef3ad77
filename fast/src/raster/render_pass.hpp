#pragma once

#include <cstdint>
#include <functional>

#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "raster/caps.hpp"

namespace halfspace::fast {

enum class Order : std::uint8_t { kFrontToBack, kBackToFront };

/// In which order a tree is displayed, what of a polygon is not seen through,
/// how many samples a pixel has each way, the caps' changes where those of all
/// rows are known, of which lazy tree it is the root, if of one, where the
/// means of samples go, if they are drawn in place of images: those of the
/// rectangle's pixels, row by row, all colours being flat then and no sample
/// showing a cap; the colours of layers where they are not the scene's; and, of
/// opaque samples, what changes their colours before they become means.
struct Pass {
  Order order = Order::kFrontToBack;
  std::uint8_t alpha = kOpaque;
  int samples = 1;
  const CapChanges* caps = nullptr;
  const LazyTree::State* lazy = nullptr;
  Rgb* means = nullptr;
  const LayerColors* colors = nullptr;
  const std::function<void(Rendering&)>* retouch = nullptr;
};

/// Lazy trees are not part of the module for the web, for its size.
#if defined(__wasm__)
constexpr bool kLazyTrees = false;
#else
constexpr bool kLazyTrees = true;
#endif

/// Displays a tree. The images, and a rectangle, are of samples.
void run(const Scene& scene, const BspTree& tree, const Camera& camera,
         const ImageOptions& image, const RenderOptions& options, Pass pass,
         Rendering& result);

/// The image of samples (S5.7), made of passes of this kind. What is blended,
/// or changed, has bytes as colours of samples, of which each pixel is the
/// mean.
Rendering run_samples(const Scene& scene, const BspTree& tree,
                      const Camera& camera, const ImageOptions& image,
                      const RenderOptions& options, const Pass& pass);

}  // namespace halfspace::fast
