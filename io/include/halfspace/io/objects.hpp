#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/moving.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::io {

/// The shift that every map may have so that all that moves is on the grid of a
/// flat scene (S12.7): objects stay in their regions, which the world's extent
/// holds.
int most_shift(const Assembly& assembly);

/// The map of an object (S12.2) from doubles: its point (x, y, z) stands at
/// rows[i] . (x, y, z, 1). Rounded here, once: entries to some 20 bits, what
/// moves to a grid step's share of that. Its shift is `most_shift` at most if
/// that leaves entries of 14 bits.
///
/// Units: model units; `inner` and `outer` are the steps of the object and of
///        its owner. What is beyond S12.2 stays beyond it.
ObjectMap object_map(const std::array<std::array<double, 4>, 3>& rows,
                     const Unit& inner, const Unit& outer,
                     int most_shift = kMapBits);

/// Where an object may be, as people say it: the corners of a box, or at least
/// 4 points of a hull. Units: model units.
using RegionPoints = std::vector<glm::dvec3>;

/// A model with regions for objects of other models (S12.1) on its grid, which
/// grows if they need that. Points are rounded to the grid's steps.
///
/// Errors: kOutOfRange: a region is beyond every grid, or no hull; the index is
///         that of the object.
Result<Model> model_on_grid(
    Scene scene,
    std::span<const std::pair<std::int32_t, RegionPoints>> objects);

}  // namespace halfspace::io
