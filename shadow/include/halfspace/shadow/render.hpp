#pragma once

#include "halfspace/fast/render.hpp"
#include "halfspace/shadow/check.hpp"

namespace halfspace::shadow {

/// fast::render(), with a share of its pixels checked.
///
/// Requires: options.items, and what fast::render() requires.
Report render(const Scene& scene, const fast::BspTree& tree,
              const Camera& camera, const ImageOptions& image,
              const fast::RenderOptions& options, fast::Rendering& result,
              const Options& how = {});

}  // namespace halfspace::shadow
