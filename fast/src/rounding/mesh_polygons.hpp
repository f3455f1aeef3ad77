#pragma once

#include <cstdint>
#include <vector>

#include "rounding/grid_mesh.hpp"

namespace halfspace::fast {

/// A strictly convex polygon of a grid mesh, all of one source.
struct MeshPolygon {
  std::vector<std::int32_t> corners;
  std::int32_t source = 0;
};

/// The triangles of each source in polygons: two that have an edge in common
/// and are exactly in one plane become one, where that is strictly convex.
/// Polygons of which no corner left their plane come out whole; a reader that
/// cuts them into triangles, whichever, has the same surface.
///
/// Sorts the triangles by their sources.
/// Cost: n log n, if few triangles have one source.
/// Source: HM83.
std::vector<MeshPolygon> polygons_of(GridMesh& mesh);

}  // namespace halfspace::fast
