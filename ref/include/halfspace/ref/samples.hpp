#pragma once

#include <cstdint>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ref/render.hpp"

namespace halfspace::ref {

/// The image with `samples` x `samples` samples a pixel (S5.7): the item image
/// of the samples, and for each pixel of `camera` the mean of its
/// samples' colours.
///
/// Requires: samples is 1, 2, 4 or 8; an image of so many times the size has at
///           most 65,536 columns and rows.
/// Exact:    yes: colours are added up before they are rounded.
Rendering render_samples(const Scene& scene, const BspTree& tree,
                         const Camera& camera, const ImageOptions& options,
                         std::int32_t samples);

}  // namespace halfspace::ref
