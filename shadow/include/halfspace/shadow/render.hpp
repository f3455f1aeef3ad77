#pragma once

#include "halfspace/fast/render.hpp"
#include "halfspace/shadow/check.hpp"

namespace halfspace::shadow {

/// fast::render(), and a chosen share of its pixels checked.
///
/// Requires: what fast::render() does, and options.items.
Report render(const Scene& scene, const fast::BspTree& tree,
              const Camera& camera, const ImageOptions& image,
              const fast::RenderOptions& options, fast::Rendering& result,
              const Options& how = {});

}  // namespace halfspace::shadow
