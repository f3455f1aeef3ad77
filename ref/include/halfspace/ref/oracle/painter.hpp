#pragma once

#include <cstdint>
#include <functional>

#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/render.hpp"

namespace halfspace::ref {

/// The image of the scene (S5.1), whose tree is `tree`, by the painter's
/// algorithm: the tree from back to front, each fragment over what is there
/// (S5.5; F2B "Back-to-front display", FAG83 sec. 2.2.2).
///
/// An oracle: its scan conversion is render()'s, its order and display are not.
/// Exact: yes.
/// Ties:  coplanar polygons: the lowest id is painted last.
Rendering paint(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& options);

/// The transparent image (S5.6): the tree from back to front, of each fragment
/// the share `alpha` / 255 of its colour and the rest of what is there; of caps
/// those behind it all before, and the others after it (S10.7).
///
/// Its items are those of paint().
/// Exact: yes.
Rendering blend(const Scene& scene, const BspTree& tree, const Camera& camera,
                const ImageOptions& options, std::uint8_t alpha);

/// The same where polygons have these colours at image points, for so many
/// samples a pixel each way (S5.7): items and colours are those of samples.
using PointColor = std::function<Rgb(PolygonId polygon, const ImagePoint& at)>;
Rendering blend_in_colors(const Scene& scene, const BspTree& tree,
                          const Camera& camera, const ImageOptions& options,
                          std::uint8_t alpha, const PointColor& color_of,
                          std::int32_t samples = 1);

}  // namespace halfspace::ref
