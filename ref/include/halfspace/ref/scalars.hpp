#pragma once

#include <cstdint>
#include <optional>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/scalars.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// The scalar of a polygon at an image point, not rounded; nothing where there
/// is no data (S11.2).
///
/// Requires: a field of the scene; the ray of the point meets the polygon's
///           plane in front of the eye.
/// Exact:    yes.
std::optional<Rational> scalar_at(const Scene& scene, const Camera& camera,
                                  const ScalarField& field, PolygonId polygon,
                                  const ImagePoint& point);

/// The colour of a scalar (S11.3).
/// Requires: is_valid(scale).
/// Exact:    yes.
Rgb color_of(const ColorScale& scale, const std::optional<Rational>& scalar);

/// The colour of a polygon by its scalar at an image point (S11.4).
///
/// Requires: as scalar_at(); is_valid(scale).
/// Exact:    yes.
Rgb scalar_color(const Scene& scene, const Camera& camera,
                 const ImageOptions& options, const ScalarField& field,
                 const ColorScale& scale, PolygonId polygon,
                 const ImagePoint& at);

/// The colours of an item image of `samples` x `samples` samples a pixel, by a
/// scalar field (S11.4).
///
/// Requires: items of the scene, the camera, these options and so many samples.
/// Exact:    yes.
ColorImage color_scalars(const Scene& scene, const Camera& camera,
                         const ImageOptions& options, const ItemImage& items,
                         const ScalarField& field, const ColorScale& scale,
                         std::int32_t samples = 1);

}  // namespace halfspace::ref
