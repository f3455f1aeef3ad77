#pragma once

#include <memory>

#include "halfspace/camera.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "raster/layers/layer_colors.hpp"

namespace halfspace::fast {

/// The colours of layers by scalars, at so many samples a pixel each way. All
/// that is given outlives them.
std::unique_ptr<const LayerColors> scalar_layers(const Scene& scene,
                                                 const Camera& camera,
                                                 const ImageOptions& options,
                                                 const ScalarColors& scalars,
                                                 std::int32_t samples);

}  // namespace halfspace::fast
