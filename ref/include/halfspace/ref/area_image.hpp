#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ref/visible_map.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// The area that a key has in a pixel, and its first moments: the centroid is
/// (x / area, y / area). Units: pixels.
struct Moments {
  Rational area = 0;
  Rational x = 0;
  Rational y = 0;
};

/// The moments of a key of a map in pixel (i, j) (S7.6): Green's theorem, arc
/// by arc.
///
/// Exact: yes.
Moments moments_of(const std::vector<MapArc>& map, std::int32_t key,
                   std::int32_t i, std::int32_t j);

/// The image of exact areas (S7.6, S10.5).
///
/// Requires: a closed scene where the options have caps.
/// Exact: yes.
/// Cost:  that of the reference's map: small scenes.
ColorImage render_area(const Scene& scene, const Camera& camera,
                       const ImageOptions& options);

}  // namespace halfspace::ref
