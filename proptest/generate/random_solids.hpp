#pragma once

#include <cstdint>
#include <vector>

#include "generate/random_scenes.hpp"
#include "halfspace/boolean.hpp"

namespace halfspace::agree {

/// How a random solid is made.
enum class SolidKind {
  kCubes,       ///< some of 3 x 3 x 3 cubes, face by face
  kSkewed,      ///< the same under a linear map
  kTetrahedra,  ///< one or two, side by side
  kBox,         ///< its faces in one or two polygons
  kHollow,      ///< a box in a box
  kTouching,    ///< boxes and wedges that touch anywhere, not only at corners
};
constexpr SolidKind kSolidKinds[] = {
    SolidKind::kCubes, SolidKind::kSkewed, SolidKind::kTetrahedra,
    SolidKind::kBox,   SolidKind::kHollow, SolidKind::kTouching};

/// A random solid in a small part of the grid, `scale` steps wide; of two of
/// them many faces, edges and corners coincide.
GridSolid random_solid(SolidKind kind, std::int64_t scale, Draws& draws);

}  // namespace halfspace::agree
