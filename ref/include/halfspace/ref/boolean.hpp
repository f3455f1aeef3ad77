#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/ref/classify.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// Whether `operation` keeps a fragment of an operand, the first or the
/// second, that is of `solid_class` against the other one (S6.4; CSG's table).
Keep keep(BooleanOp operation, SolidClass solid_class, bool first_operand);

/// The regularised boolean of two solids in one unit (S6.4, S6.5; CSG).
///
/// The trees of the operands, and so the fragments of the result, depend on
/// `options`; the point set does not. Either operand may be empty.
/// Shape: the first operand's fragments come first, each operand's by face;
///        every vertex of the result that lies on an edge is a corner there, so
///        that edges cancel in pairs.
/// Keeps: planes (a flipped face's is negated) and colours.
/// Exact: yes.
Solid boolean(BooleanOp operation, const Solid& a, const Solid& b,
              const BuildOptions& options = {});

/// Makes every vertex of the solid that lies on an edge a corner there, so that
/// edges cancel in pairs (S6.5).
void close_junctions(Solid& solid);

/// An edge that keeps a surface from being closed: as halfspace::BadEdge, with
/// rational ends (S6.1).
struct BadEdge {
  Point from;
  Point to;
  std::int64_t excess = 0;
};

/// The edges of the solid that are not used equally often in each direction,
/// in the order of their end points. Empty: closed and consistently oriented.
std::vector<BadEdge> bad_edges(const Solid& solid);

/// Six times the volume of the solid. Units: cubic grid steps.
/// Exact: yes.
Rational volume6(const Solid& solid);

/// A solid's surface in doubles, for export (S1.8). Units: model units.
///
/// The corners of face `f` are `corners[first_corner[f]]` up to but not
/// including `corners[first_corner[f + 1]]`.
struct RoundedSolid {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::uint32_t> first_corner = {0};
  std::vector<VertexId> corners;
  std::vector<Rgb> colors;  ///< one a face
  std::size_t moved = 0;    ///< coordinates that no double holds
  double max_move = 0;      ///< how far the farthest of them moved
};

/// Every coordinate of the solid, in model units, as the nearest double, ties
/// to even; infinite beyond the range of doubles (S1.8).
///
/// Shape: points that are equal before rounding are one vertex, no others.
RoundedSolid rounded(const Solid& solid, Unit unit);

}  // namespace halfspace::ref
