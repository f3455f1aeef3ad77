#pragma once

#include <cstdint>

#include "halfspace/fast/render.hpp"

namespace halfspace::fast {

/// The image with `samples` x `samples` samples a pixel (S5.7; FAG83 sec. 4.2).
///
/// Shape:    items are those of the samples, `samples` times as many each way
/// as
///           colours; options.rectangle is in pixels of `camera`.
/// Requires: samples is 1, 2, 4 or 8; an image of so many times the size has at
///           most 65,536 columns and rows; options as of render().
/// Exact:    yes: a pixel's colours are added up before they are rounded, in
///           doubles with a bound, and in rationals where that touches a step.
/// Cost:     samples are decided strip by strip, while they stay in the cache.
Rendering render_samples(const Scene& scene, const BspTree& tree,
                         const Camera& camera, const ImageOptions& image,
                         std::int32_t samples,
                         const RenderOptions& options = {});

}  // namespace halfspace::fast
