#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/fast/solid.hpp"
#include "space.hpp"

namespace halfspace::fast {

/// Adds the triangles of a face, counter-clockwise as seen from outside. Their
/// vertices are the face's, so their number is a matter of the face alone.
///
/// Exact: yes. A function of the face as a point set and its vertices, whatever
/// their ids and the order of its edges.
/// Cost:  n log n decisions for n edges, and moving what lies above a vertex.
void triangulate(const Solid& solid, const Face& face,
                 std::vector<std::array<std::int32_t, 3>>& triangles);

/// The face's vertices in order, if it is convex with one loop; else nothing.
std::vector<std::int32_t> convex_loop(const Solid& solid, const Face& face);

}  // namespace halfspace::fast
