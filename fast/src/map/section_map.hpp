#pragma once

#include "halfspace/fast/visible_map.hpp"

namespace halfspace::fast {

/// The visible map of what the clip planes of `image` leave, with its caps
/// (S10.5): cap k has the item n + k, its hatching n + 8 + k.
///
/// Requires: as visible_map(); keys of caps and hatching, too, if any; a closed
///           scene where there are caps.
Result<VisibleMap> section_map(const Scene& scene, const BspTree& tree,
                               const Camera& camera, const MapOptions& options,
                               const ImageOptions& image,
                               const MapLimits& limits);

}  // namespace halfspace::fast
