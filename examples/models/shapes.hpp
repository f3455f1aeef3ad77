#pragma once

#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"
#include "models.hpp"

namespace halfspace::models {

/// A cube of side 200 about the origin: a closed solid.
Result<Scene> cube(const ModelOptions& options);

/// `count` (3) cubes that cross each other, 72 rectangles each, turned
/// against each other by the right triangle 3, 4, 5 (FAG83 table 1, "3 cubes",
/// 216 polygons).
Result<Scene> interlocking_cubes(const ModelOptions& options);

/// Four bars, each over the next (cyclic overlap): they need a cut to be
/// ordered.
Result<Scene> pinwheel(const ModelOptions& options);

/// `count` (5) steps: a closed solid of unit squares and rectangles.
Result<Scene> stairs(const ModelOptions& options);

/// A ball of `count` (24) meridians, in triangles with coloured corners: a
/// closed solid.
Result<Scene> sphere(const ModelOptions& options);

/// A Klein bottle, a one-sided surface, in 450 triangles with coloured corners
/// (FAG83 table 1).
Result<Scene> klein_bottle(const ModelOptions& options);

/// 16 ribbons of 23 rectangles each (FAG83 table 1, "Ribbon plot").
Result<Scene> ribbons(const ModelOptions& options);

/// The quadratic instance of HEUR Theorem 1 with `count` (20) rectangles.
/// Errors: kOutOfRange where `count` is odd.
Result<Scene> theorem1(const ModelOptions& options);

/// `count` (500) random triangles in a cube of side 1000, each within a cube
/// of side `size` of its own (F2B). Units: 2^-8.
Result<Scene> random_triangles(const ModelOptions& options);

/// `count` (1000) random triangles as above, but each in a plane of its own
/// parallel to the others (F2B): no plane cuts any of them.
Result<Scene> parallel_triangles(const ModelOptions& options);

}  // namespace halfspace::models
