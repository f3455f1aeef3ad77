#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ray.hpp"
#include "halfspace/ref/predicate.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// What a ray hits, and at which ray parameter (S8.2).
struct Hit {
  PolygonId polygon = 0;
  Rational parameter;
  friend bool operator==(const Hit&, const Hit&) = default;
};

/// All that the ray hits (S8.2), in order (S8.3): each polygon is asked.
///
/// Exact: yes.
/// Ties:  equal parameter: the lowest id first.
std::vector<Hit> all_hits(const Scene& scene, const Ray& ray);

/// How far a hit is from the ray's origin, rounded once (S8.2). Units: grid
/// steps.
double distance_of(const Hit& hit, const Ray& ray);

/// The polygon seen at pixel (i, j), or kBackground (S8.4).
///
/// Requires: the pixel in the image.
/// Exact:    yes.
PolygonId pick(const Scene& scene, const Camera& camera,
               const ImageOptions& options, std::int32_t i, std::int32_t j);

/// Whether two points see each other (S8.5), given as the ray between them.
///
/// Requires: between.data().reach == Reach::kBetween.
bool see_each_other(const Scene& scene, const Ray& between);

}  // namespace halfspace::ref
