#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {

/// A regularised boolean of two solids, by its table of memberships (S6.4): the
/// points in both are in it if bit 2 is set, those in the first solid alone if
/// bit 1 is, those in the second alone if bit 0 is; those in neither never are.
enum class BooleanOp : std::uint8_t {
  kUnion = 0b111,
  kIntersection = 0b100,
  kDifference = 0b010,
  kSymmetricDifference = 0b011,
};

/// Every boolean once.
inline constexpr std::array kBooleanOps = {
    BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference,
    BooleanOp::kSymmetricDifference};

/// Whether a point is in the boolean of two solids, by whether it is in either.
constexpr bool is_member(BooleanOp operation, bool in_first, bool in_second) {
  const int place = in_first ? (in_second ? 0b100 : 0b010) : in_second ? 1 : 0;
  return (static_cast<int>(operation) & place) != 0;
}

/// A fragment of one solid's surface against the other solid (S6.3; CSG).
enum class SolidClass : std::uint8_t {
  kInside,    ///< in the other's interior
  kOutside,   ///< in the other's exterior
  kSame,      ///< on the other's surface, normals agree
  kOpposite,  ///< on the other's surface, normals oppose
};

/// The deed of a boolean with a fragment of an operand (S6.4).
enum class Keep : std::uint8_t { kDrop, kKeep, kFlip };

/// An edge that keeps a surface from being closed (S6.1): its ends, in the
/// direction in which it is used more often, and by how much more.
struct BadEdge {
  GridPoint from;
  GridPoint to;
  std::int64_t excess = 0;
  friend auto operator<=>(const BadEdge&, const BadEdge&) = default;
};

/// The edges of the scene that are not used equally often in each direction,
/// in the order of their end points. Empty: closed and consistently oriented.
std::vector<BadEdge> bad_edges(const Scene& scene);

/// A scene whose polygons are the surface of a solid (S6.1).
class GridSolid {
 public:
  const Scene& scene() const { return scene_; }

 private:
  friend Result<GridSolid> make_solid(Scene scene);
  Scene scene_;
};

/// The solid whose surface is `scene`, faces outwards (S6.1).
///
/// Requires: no two polygons cross each other or overlap (S6.2); not checked.
/// Errors:   kOpen, if bad_edges(scene) is not empty; says how many there
///           are and where the first is.
Result<GridSolid> make_solid(Scene scene);

}  // namespace halfspace
