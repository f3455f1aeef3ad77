#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/fast/solid.hpp"
#include "halfspace/progress.hpp"

namespace halfspace::fast {

/// How a surface is searched.
struct CheckOptions {
  int threads = 1;  ///< 0: as many as the machine has
  Progress progress = {};
};

/// Two faces at a place where a surface passes through itself (S6.6): they
/// cross each other's interior, overlap in one plane, or are neighbours in the
/// radial order round a segment that both enter there, or both leave.
struct SelfIntersection {
  std::int32_t first = 0;
  std::int32_t second = 0;
  /// Where it begins, rounded. Units: model units.
  std::array<double, 3> place{};
  bool in_plane = false;
  friend bool operator==(const SelfIntersection&,
                         const SelfIntersection&) = default;
};

/// Where the solid's surface passes through itself: one place for each pair of
/// faces, by the lower face and then the other.
///
/// Empty if no two faces cross or overlap, and round every edge entries and
/// exits alternate. That no component lies within another the wrong way round
/// is left to check_operand().
///
/// Requires: nothing; at the boundary of an open surface only faces that cross
///           or overlap are found.
/// Exact:    yes.
/// Threads:  any.
/// Source:   S6.6; radial order as in WEI88.
std::vector<SelfIntersection> self_intersections(const Solid& solid);

}  // namespace halfspace::fast
