#pragma once

#include "halfspace/fast/render.hpp"

namespace halfspace::fast {

/// The image of the scene by the painter's algorithm: back to front, later over
/// earlier (S5.5).
///
/// Requires: a tree without leaves.
Rendering paint(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& image, const RenderOptions& options = {});

}  // namespace halfspace::fast
