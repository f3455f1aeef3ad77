#pragma once

#include <cstdint>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// The colour of a polygon at pixel (i, j) (S5.4).
///
/// Flat: the polygon's colour. Gouraud: the affine function over the plane of
/// a triangle that takes its corner colours, at the point that the pixel's
/// CENTRE sees, each channel rounded half up; a polygon whose corner colours
/// are all equal has that colour; one without corner colours is flat.
/// Requires: the polygon covers the sample of the pixel.
/// Exact:    yes.
Rgb color_at(const Scene& scene, const Camera& camera, PolygonId polygon,
             std::int32_t i, std::int32_t j, Shading shading);

/// The colours of an item image: those of the polygons seen, or the
/// background's (S5.4).
ColorImage colors_of(const Scene& scene, const Camera& camera,
                     const ItemImage& items, const ImageOptions& options);

}  // namespace halfspace::ref
