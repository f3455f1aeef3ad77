#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/list.hpp"
#include "halfspace/fast/types.hpp"
#include "halfspace/int128.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

class Space;

/// An edge of a face, with the face on its left as seen from outside. Ends are
/// named by their points' ids: equal points have equal ids.
struct SolidEdge {
  std::int32_t from = 0;
  std::int32_t to = 0;
  /// A plane through the edge that is not the face's; -1 where none is known
  /// yet, and then both ends lie on the grid.
  std::int32_t other = -1;
  friend bool operator==(const SolidEdge&, const SolidEdge&) = default;
};

/// A face of a solid: a region of a plane, bounded by edges. It need be neither
/// convex nor connected, and it may have holes.
struct Face {
  std::int32_t plane = -1;
  bool flipped = false;  ///< outwards is against the plane's normal
  Rgb color;
  /// Where the face came from: which operand of the last boolean, and which of
  /// that operand's faces. In a solid that no boolean made, itself.
  bool from_first = true;
  PolygonId source = 0;
  /// Where it came from in the first place: the part's number, given when the
  /// solid was made, and the polygon there.
  std::int32_t part = 0;
  PolygonId polygon = 0;
  /// Its edges are `edges[first_edge]` and the `edge_count - 1` after it, which
  /// are no other face's. The face of a half-space has none: it is all of its
  /// plane.
  std::uint32_t first_edge = 0;
  std::uint32_t edge_count = 0;
  Box box;  ///< holds the face, rounded outwards
};

/// A solid, exactly: its vertices are points of the grid or meets of three of
/// its planes, and its planes are those of the polygons it came from (S6.5).
///
/// Solids share the table of planes and points if they are made from each
/// other or with to_solid(solid, other). Tables only grow, so a solid never
/// changes; but booleans on solids of one table must not run at the same time.
struct Solid {
  List<Face> faces;
  List<SolidEdge> edges;
  bool unbounded = false;  ///< what is far away is inside
  Unit unit;
  std::shared_ptr<Space> space;
  /// Known to be noded: wherever a vertex lies on an edge it is an end of it,
  /// and no face has a part of an edge in it that is not one of its own edges
  /// from end to end. Results of booleans of such solids are. Of others a
  /// boolean finds out what it has to know.
  bool is_conforming = false;
};

/// The same solid, its points and planes in a table of its own. Face `p` is
/// polygon `p`. `part` is noted as where the faces came from.
Solid to_solid(const GridSolid& solid, std::int32_t part = 0);

/// Likewise in the table of `with`, for long chains of booleans.
/// Requires: its grid has no fewer bits than the solid's.
Solid to_solid(const GridSolid& solid, const Solid& with,
               std::int32_t part = 0);

/// What is outside of the solid, regularised. An operand like any other.
Solid complement(Solid solid);

/// The points that are on the negative side of a plane, given by three points
/// of the grid that are not on one line: an operand in the table of `with`.
///
/// Requires: a boolean of it must have a bounded surface, as the intersection
///           of a solid with it has.
Solid half_space(const std::array<GridPoint, 3>& corners, const Solid& with);

/// The parts of the solid on either side of the plane through three points of
/// the grid, both closed (S6.5).
struct Halves {
  Solid positive;
  Solid negative;
};
Halves split(const Solid& solid, const std::array<GridPoint, 3>& corners);

/// The points in exactly one of two solids in one unit, regularised. Shape,
/// Keeps, Exact, Cost: as boolean().
Solid symmetric_difference(const Solid& a, const Solid& b, int threads = 1);

/// Which faces in one plane that face the same way become one.
enum class Merge : std::uint8_t {
  kOrigin,  ///< parts of one polygon of one part
  kColor,   ///< those of one colour
  kPlane,   ///< all: the least surface
};

/// The solid with faces that share an edge merged, and with no vertex left at
/// which nothing turns. What is merged counts as a part of the first face.
///
/// Keeps: the point set, and with it the planes. Edges at which other faces
///        meet too, where the surface touches itself, stay.
/// Cost:  of a solid that is given away no copy: what is merged takes the place
///        of what was there, and most is but looked at.
Solid merge_faces(Solid solid, Merge rule);

/// The plane normal.(p - origin) = 0. The normal's components have no common
/// divisor, and its first one that is not zero is positive.
struct SolidPlane {
  std::array<Int128, 3> normal;
  GridPoint origin;
};
SolidPlane plane_at(const Solid& solid, std::int32_t plane);

/// A point: of the grid, or where three planes meet.
struct SolidVertex {
  bool is_grid = true;
  GridPoint point;
  std::array<std::int32_t, 3> planes{};
};
SolidVertex vertex_at(const Solid& solid, std::int32_t vertex);

}  // namespace halfspace::fast
