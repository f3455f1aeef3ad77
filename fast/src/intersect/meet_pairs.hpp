#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "intersect/operand.hpp"

namespace halfspace::fast {

/// Adds to the operands' lists and to the segments what pairs of faces have in
/// common, pair after pair (FaceIntersector::meet()), and to the table the
/// points at which they meet.
///
/// Threads share all but giving points their ids: one thread does so, in the
/// order of the pairs, so that ids are the same for any number of them.
void meet_pairs(Operand& a, Operand& b,
                std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
                GeometryTable& table, List<IntersectionSegment>& segments,
                int threads);

}  // namespace halfspace::fast
