#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ray.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// The first hit of the ray (S8.3) in the scene whose tree is `tree`, or
/// nothing: near subtree, node, far subtree, as far as the ray reaches and
/// until nothing can be nearer.
///
/// Any tree will do, one of build_display_tree() with small leaves is fastest.
/// Exact: yes: doubles with bounds, and integers of 256 and 512 bits where they
///        do not tell. No recursion.
/// Ties:  equal parameter: the lowest id.
/// Cost:  the way of the ray through the tree.
std::optional<RayHit> first_hit(const Scene& scene, const BspTree& tree,
                                const Ray& ray);
std::optional<RayHit> first_hit(const Scene& scene, const BspTree& tree,
                                const Ray& ray, FilterStats& stats);

/// All that the ray hits (S8.2), in order (S8.3).
///
/// Exact: yes.
/// Ties:  equal parameter: the lowest id first.
std::vector<RayHit> all_hits(const Scene& scene, const BspTree& tree,
                             const Ray& ray);

/// The polygon seen at pixel (i, j), or kBackground (S8.4): what the ray of
/// its sample meets first, through the tree.
///
/// Requires: the pixel in the image.
/// Exact:    yes.
PolygonId pick(const Scene& scene, const BspTree& tree, const Camera& camera,
               const ImageOptions& options, std::int32_t i, std::int32_t j);

/// Whether two points see each other (S8.5), given as the ray between them.
///
/// Requires: between.data().reach == Reach::kBetween.
bool see_each_other(const Scene& scene, const BspTree& tree,
                    const Ray& between);

}  // namespace halfspace::fast
