#pragma once

#include "intersect/operand.hpp"

/// A second plane through an edge, not that of its face: the edge is where the
/// two planes meet. Added to the table where no face has one.
namespace halfspace::fast {

/// For an operand's edge; stored in the edge for the next call.
std::int32_t transversal_plane(OperandEdge& edge, GeometryTable& table);

/// For an edge whose other faces are not known.
std::int32_t transversal_plane(const SolidEdge& edge, const Face& face,
                               GeometryTable& table);

}  // namespace halfspace::fast
