#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "halfspace/camera.hpp"
#include "halfspace/ray.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::io {

/// A ray, and how far rounding moved its ends. Units: grid steps.
struct RoundedRay {
  Ray ray;
  double max_move = 0;
};

/// The ray from one point to another, or from a point in a direction, rounded
/// once to the lattice (S8.1). Units: model units.
///
/// A direction is made as long as the lattice allows, so that its rounding does
/// not matter, unless its three numbers are on the lattice.
/// Errors: kNotFinite, kOutOfRange, kBadRay.
Result<RoundedRay> ray_between(const Scene& scene, const glm::dvec3& from,
                               const glm::dvec3& to, Reach reach);
Result<RoundedRay> ray_along(const Scene& scene, const glm::dvec3& from,
                             const glm::dvec3& direction);

/// How far a hit is from its ray's origin: the nearest double (S8.2). Units:
/// model units.
double distance_of(const RayHit& hit, const Ray& ray, const Unit& unit);

/// The ray parameter: the nearest double, and exactly, as `-3/7` or `2`.
double parameter_of(const RayHit& hit);
std::string exact_parameter_of(const RayHit& hit);

/// The point that is hit, each coordinate to the nearest double. Units: model
/// units.
glm::dvec3 point_of(const RayHit& hit, const Ray& ray, const Unit& unit);

/// The point of a polygon that the centre of a pixel sees, each coordinate to
/// the nearest double, and its distance from the eye, or from the image plane
/// of an orthographic view. Units: model units.
///
/// Requires: the polygon covers the pixel's sample.
struct PixelPoint {
  glm::dvec3 point{};
  double distance = 0;
};
PixelPoint pixel_point(const Scene& scene, const Camera& camera,
                       PolygonId polygon, std::int32_t i, std::int32_t j);

}  // namespace halfspace::io
