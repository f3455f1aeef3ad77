#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/feed_order.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// The fragments of a tree as vertices for a renderer of one's own: the same
/// for every eye (S3.8).
struct FragmentVertices {
  /// A vertex a corner, fragment by fragment. Units: grid steps; corners that
  /// cuts have made are within a few ulps.
  std::vector<std::array<double, 3>> positions;
  std::vector<PolygonId> polygons;  ///< by vertex: the fragment's source
  /// By fragment: its first vertex; and the end.
  std::vector<std::uint32_t> first_vertex = {0};
};

/// Requires: a tree of this scene without leaves (divide_leaves()).
/// Errors:   none; there are at most 2^32 - 1 corners.
FragmentVertices fragment_vertices(const Scene& scene, const BspTree& tree);

/// The triangles of the fragments that an eye sees, three vertices each, in an
/// order in which none is hidden by one before it, or by one after it (S3.7).
///
/// Shape: of each fragment the fan from its first corner, fragment by fragment.
///        Fragments whose plane holds the eye are left out.
/// Exact: yes.
std::vector<std::uint32_t> order_indices(const Scene& scene,
                                         const BspTree& tree,
                                         const FragmentVertices& vertices,
                                         const Camera& camera, FeedOrder order);

}  // namespace halfspace::fast
