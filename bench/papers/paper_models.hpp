#pragma once

#include <cstdint>

#include "halfspace/scene.hpp"

namespace halfspace::bench {

/// FAG83 fig. 7, "3 atoms": three balls of 440 triangles each that reach into
/// each other. The paper gives only the size of the tree.
Scene three_atoms();

/// HEUR fig. 4: 126 polygons of four cylinders (ten sides), four cones (eight
/// sides) and seven blocks, standing on a floor in places that `seed` draws;
/// none touches another.
Scene cylinders_cones_blocks(std::uint64_t seed);

/// HEUR fig. 7: three groups of `per_group` upright rectangles, in each of
/// which every polygon's plane cuts the next polygon, round in a circle.
/// Requires: per_group >= 3.
Scene cyclic_groups(std::int32_t per_group, std::uint64_t seed);

}  // namespace halfspace::bench
