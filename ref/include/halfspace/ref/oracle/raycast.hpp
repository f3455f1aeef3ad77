#pragma once

#include <cstdint>
#include <span>

#include "halfspace/ref/render.hpp"

namespace halfspace::ref {

/// The image of the scene (S5.1) by casting the ray of every sample at the
/// polygons and keeping the first hit (S5.5).
///
/// An oracle: the geometry of points in space, pixel by pixel. No tree, no
/// projection, no edges in the image; and the sample (S4.4) is no rule about
/// derivatives here but a point, whose coordinates are polynomials in the
/// infinitely small e.
/// Exact: yes.
/// Ties:  equal ray parameter means coplanar: the lowest id is hit.
/// Cost:  every polygon meets every ray of the rows and columns it touches.
Rendering raycast(const Scene& scene, const Camera& camera,
                  const ImageOptions& options);

/// The polygon of `ids` that the sample of pixel (i, j) sees: one of them, or
/// kBackground. One ray of raycast(), without the image around it.
///
/// Requires: the pixel in the image; ids ascending.
/// Exact:    yes.
/// Ties:     as above.
/// Cost:     every polygon of `ids` meets the ray.
PolygonId raycast_at(const Scene& scene, const Camera& camera,
                     const ImageOptions& options, std::int32_t i,
                     std::int32_t j, std::span<const PolygonId> ids);

}  // namespace halfspace::ref
