#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/fast/solid.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// Adds the triangles of a face, counter-clockwise as seen from outside. Their
/// vertices are the face's, so their number is a matter of the face alone.
///
/// Exact: yes. A function of the face as a point set and its vertices, whatever
/// their ids and the order of its edges.
/// Cost:  n log n decisions for n edges, and moving what lies above a vertex.
void triangulate(const Solid& solid, const Face& face,
                 std::vector<std::array<std::int32_t, 3>>& triangles);

/// The vertices of `edges`, which are edges of the face, in order, if they are
/// one loop round a convex region; else nothing.
std::vector<std::int32_t> convex_loop(const Solid& solid, const Face& face,
                                      std::span<const SolidEdge> edges);

/// Puts triangles of a face together again where they are all of a part of it
/// that hangs together and is convex. Adds the polygons that result.
void join_convex(const Solid& solid, const Face& face,
                 const std::vector<std::array<std::int32_t, 3>>& triangles,
                 std::vector<std::vector<std::int32_t>>& polygons);

}  // namespace halfspace::fast
