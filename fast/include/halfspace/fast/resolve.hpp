#pragma once

#include <cstddef>
#include <vector>

#include "halfspace/fast/self_intersections.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// The result of resolve().
struct Resolved {
  Solid solid;
  /// Where faces crossed or overlapped.
  std::vector<SelfIntersection> self_intersections;
  std::size_t faces_cut = 0;      ///< of which parts are left
  std::size_t faces_dropped = 0;  ///< of which nothing is left
};

/// The surface of the points that the solid's surface winds round at least once
/// (S6.2, S6.7), which does not cross itself. A conforming solid without
/// self-intersections comes out as it is; where a surface touches itself along
/// a segment, or a vertex lies on an edge, faces and edges are cut.
///
/// Requires: bounded, and closed: bad_edges(solid) is empty. No face's own
///           edges cross each other: none of to_solid() has such.
/// Shape: as of boolean(): closed, and faces are parts of the solid's.
/// Exact: yes.
/// Threads: any.
Resolved resolve(const Solid& solid);

}  // namespace halfspace::fast
