#pragma once

#include <array>
#include <cstdint>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// A colour before it is rounded: red, green, blue.
using ExactColor = std::array<Rational, 3>;

/// The shares of a triangle's corners in the point that the image point sees
/// in its plane: barycentric coordinates, which sum up to 1.
///
/// Requires: the ray of the point meets the triangle's plane in front of the
/// eye. Exact:    yes.
std::array<Rational, 3> corner_shares(const Scene& scene, const Camera& camera,
                                      PolygonId triangle,
                                      const ImagePoint& point);

/// The colour of a polygon at an image point (S5.4, S5.7), as color_at()
/// without the rounding.
///
/// Requires: the ray of the point meets the polygon's plane in front of the
///           eye.
/// Exact:    yes.
ExactColor exact_color_at(const Scene& scene, const Camera& camera,
                          PolygonId polygon, const ImagePoint& point,
                          Shading shading);

/// Each channel rounded half up.
Rgb rounded_color(const ExactColor& color);
ExactColor exact(const Rgb& color);

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

/// A mark in the light of a polygon that has this colour (S5.8).
Rgb marked(const Rgb& mark, const Rgb& color);

/// Colours what is seen from behind by a mark, in its own light (S5.8).
///
/// Requires: colours of these items, which are of the scene and the camera.
/// Exact:    yes.
void mark_back_faces(const Scene& scene, const Camera& camera,
                     const ItemImage& items, const Rgb& mark,
                     ColorImage& colors);

}  // namespace halfspace::ref
