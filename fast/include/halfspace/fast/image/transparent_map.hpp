#pragma once

#include "halfspace/fast/visible_map.hpp"

namespace halfspace::fast {

/// The transparent map of a scene whose tree is `tree` (S7.8): a region a
/// composed colour.
///
/// From front to back every fragment is cut out of all cells that it covers,
/// which note it behind what they have; then each cell's colour is composed
/// from the farthest polygon on.
/// Shape:    as visible_map(); a region's `item` is its key, kBackground where
///           no polygon is.
/// Requires: a tree of this scene; an alpha of its own for every polygon or for
///           none.
/// Exact:    yes, as visible_map().
/// Errors:   kOutOfRange: more cells than the limit; says how many.
/// Cost:     all that is in the image: up to the square of the polygons.
Result<VisibleMap> transparent_map(const Scene& scene, const BspTree& tree,
                                   const Camera& camera,
                                   const TransparentOptions& options,
                                   const MapLimits& limits = {});

/// That of what the clip planes of `image` leave, with its caps (S10.7).
///
/// Of `image` only clip planes, caps and parts count.
/// Requires: as transparent_map(); own alphas of caps for all of them or for
///           none; a closed scene where there are caps.
/// Exact, errors, cost: as transparent_map().
Result<VisibleMap> transparent_section(const Scene& scene, const BspTree& tree,
                                       const Camera& camera,
                                       const TransparentOptions& options,
                                       const ImageOptions& image,
                                       const MapLimits& limits = {});

}  // namespace halfspace::fast
