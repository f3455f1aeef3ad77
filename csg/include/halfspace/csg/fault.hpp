#pragma once

#include <span>

#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::csg {

/// Why a surface is not closed or not consistently oriented (S6.1), in the
/// terms of its file: how many bad edges in how many places, whether polygons
/// are missing or run the same way, the first of them in model units with the
/// polygons of the file there, and what would mend it.
///
/// `polygons` gives for each polygon of the scene the one in its file.
/// Requires: bad_edges(scene) is not empty.
/// Shape:    code kOpen; index: the first polygon of the file concerned.
Error open_error(const Scene& scene, std::span<const PolygonId> polygons);

}  // namespace halfspace::csg
