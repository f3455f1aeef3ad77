#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace halfspace::fast {

/// Walks round a fragment whose vertices have the given signs, not all on one
/// side, and gives the corners of both parts in order (S2.3).
///
/// Calls put(side, k, crossing, cut): the next corner of the part on the
/// positive (side > 0) or negative side is vertex k, or if `crossing` the point
/// in which edge k passes through the plane; the edge that leaves it is edge k,
/// or if `cut` the plane's. Two calls follow each other for a crossing, one for
/// each part.
template <class Put>
void walk_split(const std::vector<std::int8_t>& signs, Put&& put) {
  const std::size_t count = signs.size();
  for (std::size_t k = 0; k < count; ++k) {
    const int here = signs[k];
    const int there = signs[k + 1 == count ? 0 : k + 1];
    // Where the boundary passes through the plane, the part that it leaves goes
    // on along the cut, the part that it enters along the edge.
    if (here == 0) {
      put(-there, k, false, true);
      put(there, k, false, false);
    } else {
      put(here, k, false, false);
      if (there == -here) {
        put(here, k, true, true);
        put(there, k, true, false);
      }
    }
  }
}

}  // namespace halfspace::fast
