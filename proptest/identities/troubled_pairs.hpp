#pragma once

#include <cstdint>
#include <utility>

#include "generate/random_scenes.hpp"
#include "halfspace/boolean.hpp"

namespace halfspace::identities {

/// What a pair of solids is made to hurt booleans with.
enum class Trouble : std::uint8_t {
  kNearlyInPlane,   ///< faces a grid step from being in one plane
  kTurnedABit,      ///< prisms on one floor, turned by a few grid steps
  kRoundAnEdge,     ///< tetrahedra with an edge in common, and no more
  kAtAPoint,        ///< pyramids that meet in their tips
  kShellInShell,    ///< many cavities and solids in them, some coincide
  kCutOtherwise,    ///< hills of the same heights in other triangles
  kSlivers,         ///< tetrahedra a few steps thick and long as the grid
  kThroughCorners,  ///< a solid through the other's corners and edges
};
constexpr Trouble kTroubles[] = {
    Trouble::kNearlyInPlane, Trouble::kTurnedABit,    Trouble::kRoundAnEdge,
    Trouble::kAtAPoint,      Trouble::kShellInShell,  Trouble::kCutOtherwise,
    Trouble::kSlivers,       Trouble::kThroughCorners};
const char* name_of(Trouble trouble);

/// A random pair of such solids on one grid, near the origin or far from it.
std::pair<GridSolid, GridSolid> troubled_pair(Trouble trouble,
                                              agree::Draws& draws);

}  // namespace halfspace::identities
