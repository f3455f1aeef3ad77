#pragma once

#include <vector>

#include "definition/definition.hpp"
#include "halfspace/ray.hpp"
#include "halfspace/scene_file.hpp"

/// Rays that are made to hurt, and what they hit by definition (S8).
namespace halfspace {

/// A hit by its exact parameter.
struct ExactHit {
  PolygonId polygon = 0;
  definition::Fraction parameter;
  friend bool operator==(const ExactHit&, const ExactHit&) = default;
};

/// The integer that the words of a hit spell.
definition::Integer to_integer(const RayInteger& words);

/// Rays through what a scene has corners, edges, faces and an eye for: from and
/// to corners, middles of edges and points within, in every reach, along edges
/// and in planes.
std::vector<Ray> rays_of(const SceneFile& view);

/// The polygons of a scene, by id.
std::vector<definition::Facet> facets_of(const Scene& scene);

/// The hits from the definition (S8.2), sorted (S8.3).
std::vector<ExactHit> hits_by_definition(
    const std::vector<definition::Facet>& facets, const Ray& ray);

}  // namespace halfspace
