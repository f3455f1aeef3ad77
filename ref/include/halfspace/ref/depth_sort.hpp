#pragma once

#include <cstddef>

#include "halfspace/camera.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// A list priority, and what it took (S3.9).
struct DepthSort {
  /// The list, as a tree that is a chain: front_to_back() gives it.
  BspTree list;
  std::size_t moves = 0;
  std::size_t cuts = 0;
};

/// The list priority of the scene for the camera, by depth sort (S3.9; NNS72).
///
/// Polygons whose planes no ray of the image meets are not listed (S3.10).
/// Requires: the list is displayed for this camera alone.
/// Exact:    yes: all tests are, those of extents and images, too.
/// Cost:     the square of the number of polygons, and more where they cut.
DepthSort depth_sort(const Scene& scene, const Camera& camera);

}  // namespace halfspace::ref
