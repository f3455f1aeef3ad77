#pragma once

#include <cstddef>
#include <cstdint>

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

/// The image with `samples` x `samples` samples a pixel (S5.7): the item image
/// of the samples, and for each pixel of `camera` the mean of its
/// samples' colours.
///
/// Requires: samples is 1, 2, 4 or 8; an image of that many times the size has
///           at most 65,536 columns and rows.
/// Exact:    yes: colours are added up before they are rounded.
Rendering render_samples(const Scene& scene, const BspTree& tree,
                         const Camera& camera, const ImageOptions& options,
                         std::int32_t samples);

}  // namespace halfspace::ref
