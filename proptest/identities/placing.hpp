#pragma once

#include <optional>
#include <string>
#include <utility>

#include "halfspace/boolean.hpp"
#include "halfspace/result.hpp"

namespace halfspace::identities {

/// How the second of two solids stands to the first.
enum class Position : std::uint8_t {
  kGeneral,   ///< with nothing in common but by chance
  kLow,       ///< the low corners of their boxes in one point
  kBeside,    ///< its box touches the other's, and shares the low edges
  kVertex,    ///< its first vertex on the other's
  kSame,      ///< as it is: for a solid with itself
  kStep,      ///< one grid step along the first axis
  kAlong,     ///< the whole of the first polygon's first edge
  kAlongBit,  ///< the least grid step along that edge
};
constexpr Position kPositions[] = {Position::kGeneral, Position::kLow,
                                   Position::kBeside,  Position::kVertex,
                                   Position::kSame,    Position::kStep,
                                   Position::kAlong,   Position::kAlongBit};
const char* name_of(Position position);

/// The mesh in a file as a solid about the origin, in steps of 1: without the
/// vertices that no polygon has. Errors: those of reading it; kOpen.
Result<GridSolid> load(const std::string& path);

/// The second solid brought to about the first one's size by a power of two,
/// and put where the position says; both on one grid. Nothing if the position
/// is one for a solid with itself and they are two, or if no grid holds them.
std::optional<std::pair<GridSolid, GridSolid>> placed(const GridSolid& a,
                                                      const GridSolid& b,
                                                      Position position);

}  // namespace halfspace::identities
