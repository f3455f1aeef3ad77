#pragma once

#include <cstddef>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/image.hpp"
#include "halfspace/moving.hpp"
#include "halfspace/result.hpp"

namespace halfspace::fast {

/// What becomes of polygons that reach into a region of their model (S12.4).
enum class InRegion : std::uint8_t {
  kError,  ///< they are an error
  kCut     ///< what is inside is cut away
};

/// The tree of one model (S12.4; FAG83 sec. 4.1): a display tree of its
/// polygons, no splitter of which cuts a region of its objects.
struct ModelTree {
  BspTree tree;
  /// By node: the object that is displayed there, or -1.
  std::vector<std::int32_t> object_at;
};

/// The trees of all models. They stay as they are while objects move, come and
/// go: many objects of one model share its tree.
struct MovingTrees {
  std::vector<ModelTree> models;
};

/// The trees of an assembly.
///
/// Errors: kOutOfRange: a region is not free, and what is in it is not to be
///         cut; regions so interlocked that every plane across an axis between
///         two of them cuts a third. The index is that of the polygon, or the
///         object.
/// Exact:  yes.
/// Cost:   that of a display tree; a region adds some seven nodes.
Result<MovingTrees> build_moving_trees(const Assembly& assembly,
                                       InRegion in_region,
                                       const DisplayTreeOptions& options = {});

/// The tree of one of its models, for where objects came and went: the trees of
/// the others stay. Errors, cost: those of build_moving_trees(), of the model.
Result<ModelTree> build_model_tree(const Assembly& assembly, std::int32_t model,
                                   InRegion in_region,
                                   const DisplayTreeOptions& options = {});

/// The image of an assembly whose objects are placed so (S12.5).
///
/// The world's tree is displayed front to back (S3.7). Where the walk comes to
/// a region, the object in it is displayed from its own tree, by the camera in
/// the object's frame: a map keeps ray parameters and sides, so that nothing of
/// the object is computed but what is seen.
///
/// Clip planes and caps are those of the world, on its grid (S12.5).
/// Requires: the assembly's trees; options as of render(); with caps surfaces
///           that are all closed, with free regions (S12.4).
/// Exact:    yes: doubles with bounds, integers of 896 bits where they touch.
/// Cost:     that of the world's image, and for each region that is seen a
///           walk of its object's tree.
Rendering render_moving(const Assembly& assembly, const MovingTrees& trees,
                        const Placement& placement, const Camera& camera,
                        const ImageOptions& image,
                        const RenderOptions& options = {});

/// The memory of all trees. Units: bytes.
std::size_t bytes_of(const MovingTrees& trees);

}  // namespace halfspace::fast
