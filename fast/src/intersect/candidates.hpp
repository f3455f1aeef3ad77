#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "intersect/operand.hpp"

/// Broad phase: which faces of two operands are near each other.
namespace halfspace::fast {

/// Makes room, makes blocks of edges where there are none yet, and finds how
/// far either operand reaches.
void prepare(Operand& a, Operand& b, BooleanScratch& scratch);

/// The pairs of faces whose boxes overlap; fills in `active`.
List<std::pair<std::int32_t, std::int32_t>> candidate_pairs(Operand& a,
                                                            Operand& b,
                                                            int threads = 1);

/// Fills in the near edges of the active faces.
void add_edges(Operand& operand, const GeometryTable& table);

}  // namespace halfspace::fast
