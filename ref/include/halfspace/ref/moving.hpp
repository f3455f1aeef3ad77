#pragma once

#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/moving.hpp"
#include "halfspace/ref/predicate.hpp"
#include "halfspace/ref/render.hpp"

namespace halfspace::ref {

/// Whether every region is free (S12.4): no polygon of its owner has a part
/// inside it.
///
/// Errors: kOutOfRange: the first region, and the first polygon in it; the
///         index is that of the polygon in its model.
Result<Done> check_free(const Assembly& assembly);

/// The polygons of all occurrences, moved to the world (S12.5), but for what is
/// inside of regions of their owners; and their planes by id.
///
/// Fragments are in the order of ids; `source` is the id. Exact: yes.
struct MovedPolygons {
  std::vector<Fragment> fragments;
  std::vector<Plane> planes;
};
MovedPolygons moved_polygons(const Assembly& assembly,
                             const Placement& placement);

/// The image of the moved polygons (S12.5): a tree of all of them, and F2B's
/// method. Regions and objects play no part in it.
///
/// Requires: with caps surfaces that are all closed, and check_free().
/// Exact:    yes.
Rendering render_moving(const Assembly& assembly, const Placement& placement,
                        const Camera& camera, const ImageOptions& options);

/// The moved polygons as a scene of their own (S12.7).
///
/// Requires: check_free().
/// Errors:   kOutOfRange: a grid of 54 bits does not hold the corners, or the
///           camera.
Result<FlatScene> flat_scene(const Assembly& assembly,
                             const Placement& placement, const Camera& camera);

}  // namespace halfspace::ref
