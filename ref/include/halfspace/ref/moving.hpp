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

/// Moved polygons as an ordinary scene, in steps so fine that all their corners
/// are on its grid, with the camera that sees it alike.
struct FlatScene {
  Scene scene;
  Camera camera;
  std::vector<PolygonId> ids;  ///< by polygon of the scene
  int shift = 0;               ///< a step of the world is 2^shift of its steps
};

/// Requires: check_free().
/// Errors:   kOutOfRange: a grid of 54 bits does not hold the corners, or the
///           camera.
Result<FlatScene> flat_scene(const Assembly& assembly,
                             const Placement& placement, const Camera& camera);

/// The options by which the flat scene has the same image: clip planes on its
/// grid, and parts of its polygons.
///
/// Errors: those of make_clips().
Result<ImageOptions> flat_options(const FlatScene& flat,
                                  const ImageOptions& options);

/// The item of the moved polygons for one of the flat scene, caps too.
PolygonId moved_item(const Assembly& assembly, const FlatScene& flat,
                     PolygonId item);

}  // namespace halfspace::ref
