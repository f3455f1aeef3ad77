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

class SharedTable;

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
/// Solids made from each other, or by to_solid(solid, other), share a table of
/// planes and points. Tables only grow, so a solid never changes. A default
/// solid is empty and has no table.
///
/// Threads: every function that takes solids as const may run in any thread at
///          any time, on solids of one table or not.
struct Solid {
  List<Face> faces;
  List<SolidEdge> edges;
  bool unbounded = false;  ///< what is far away is inside
  Unit unit;
  std::shared_ptr<const SharedTable> table;
  /// Known to be a conforming mesh (what JTS calls noded): every vertex on an
  /// edge is an end of it, and an edge that lies in a face is one of the face's
  /// own, from end to end. Booleans of conforming solids are. A boolean checks
  /// others where it has to.
  bool is_conforming = false;
};

/// The same solid, its points and planes in a table of its own. Face `p` is
/// polygon `p`. `part` is noted as where the faces came from.
Solid to_solid(const GridSolid& solid, std::int32_t part = 0);

/// The same in the table of `with`, for long chains of booleans; in a table of
/// its own while another thread extends that one.
Solid to_solid(const GridSolid& solid, const Solid& with,
               std::int32_t part = 0);

/// What is outside of the solid, regularised. An operand like any other.
Solid complement(Solid solid);

/// The points that are on the negative side of a plane, given by three points
/// of the grid that are not on one line: an operand in the unit of `with`, and
/// in its table as by to_solid(solid, with).
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
