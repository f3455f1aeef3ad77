#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/fast/simd.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// A part of the image: columns `left` up to but not including `right`, lines
/// `top` up to but not including `bottom`. Units: pixels.
struct Rectangle {
  std::int32_t left = 0;
  std::int32_t top = 0;
  std::int32_t right = 0;
  std::int32_t bottom = 0;
  friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

/// Options of render() that do not change a pixel.
struct RenderOptions {
  int threads = 1;  ///< 0: as many as the machine has
  /// The part of the image that is wanted; nothing: all of it. It must lie in
  /// the image and not be empty.
  std::optional<Rectangle> rectangle;
  bool items = true;                  ///< false: leave Rendering::items empty
  bool colors = true;                 ///< false: leave Rendering::colors empty
  SimdLevel simd = SimdLevel::kBest;  ///< of the innermost loops
};

/// An image, and what it took.
struct Rendering {
  ItemImage items;    ///< of the rectangle
  ColorImage colors;  ///< of the rectangle
  /// How often a pixel was set: for render() those that are not background,
  /// else as often as it was overwritten.
  std::size_t pixels_painted = 0;
  /// How many fragments were displayed; a band of lines counts its own.
  std::size_t fragments_displayed = 0;
  /// How often a fragment set pixels of a tile of 32 x 8; of render_samples(),
  /// samples.
  std::size_t tiles_touched = 0;
  /// Decisions of splitters against the eye, of scan lines and of channels.
  FilterStats decisions;
};

/// The image of the scene (S5.1), whose tree is `tree`: from front to back,
/// onto a screen of tiles, until that is full (S5.5).
///
/// The images do not depend on the number of threads, nor a pixel of them on
/// the rectangle.
/// Requires: options.threads >= 0; a rectangle within the image.
/// Exact:    yes: doubles with bounds, and integers where they touch.
/// Ties:     coplanar polygons: the lowest id is seen.
/// Cost:     what is seen, and the way to it.
///           A thread keeps up to 32 MiB of what its last image took, for the
///           next.
Rendering render(const Scene& scene, const BspTree& tree, const Camera& camera,
                 const ImageOptions& image, const RenderOptions& options = {});

/// The same into a rendering that is there: no memory is asked for where the
/// sizes agree.
void render(const Scene& scene, const BspTree& tree, const Camera& camera,
            const ImageOptions& image, const RenderOptions& options,
            Rendering& result);

/// The image with `samples` x `samples` samples a pixel (S5.7; FAG83 sec. 4.2).
///
/// Shape:    items are those of the samples, `samples` times as many each way
///           as colours; options.rectangle is in pixels of `camera`.
/// Requires: samples is 1, 2, 4 or 8; an image of that many times the size has
///           at most 65,536 columns and rows; options as of render().
/// Exact:    yes: a pixel's colours are added up before they are rounded, in
///           doubles with a bound, and in rationals where that touches a step.
/// Cost:     samples are decided strip by strip, while they stay in the cache.
Rendering render_samples(const Scene& scene, const BspTree& tree,
                         const Camera& camera, const ImageOptions& image,
                         std::int32_t samples,
                         const RenderOptions& options = {});

}  // namespace halfspace::fast
