#pragma once

#include <cstddef>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// An image, and what it took.
struct Rendering {
  ItemImage items;
  ColorImage colors;
  /// How often a pixel was set: for render() the pixels that are not
  /// background, else as often as it was overwritten.
  std::size_t pixels_painted = 0;
  /// How many fragments, or polygons, were displayed.
  std::size_t fragments_displayed = 0;
};

/// The image of the scene (S5.1), whose tree is `tree`, by F2B's method: the
/// tree from front to back, onto the dynamic screen, until that is full
/// (S5.5).
///
/// Exact: yes.
/// Ties:  coplanar polygons: the lowest id is seen.
Rendering render(const Scene& scene, const BspTree& tree, const Camera& camera,
                 const ImageOptions& options);

}  // namespace halfspace::ref
