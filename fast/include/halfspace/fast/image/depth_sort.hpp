#pragma once

#include <cstddef>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// A list priority, and what it took (S3.9).
struct DepthSort {
  /// The list, as a tree that is a chain: render(), paint(), front_to_back()
  /// and the like take it as they take a tree of the scene.
  BspTree list;
  std::size_t pairs = 0;  ///< fragments compared beyond their depths
  std::size_t moves = 0;  ///< fragments that took another one's place
  std::size_t cuts = 0;
  FilterStats decisions;
};

/// The list priority of the scene for the camera, by depth sort (S3.9; NNS72).
///
/// A pure function of its arguments.
/// Polygons whose planes no ray of the image meets are not listed (S3.10).
/// Requires: the list is displayed for this camera alone; the near distance
///           does not matter.
/// Exact:    yes: sides of planes are decided. Depths and images are compared
///           in doubles with bounds; where these touch, the planes decide.
/// Cost:     for each fragment a pass over those whose depths meet its own; a
///           list that is good for one eye only.
DepthSort depth_sort(const Scene& scene, const Camera& camera);

}  // namespace halfspace::fast
