#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/fast/solid.hpp"
#include "halfspace/result.hpp"
#include "halfspace/solid_file.hpp"

namespace halfspace::fast {

/// The solid as planes and as what meets where, exactly. Planes and vertices
/// are numbered as the faces name them, so equal solids whose faces and edges
/// are in one order have equal data, whatever table they are in.
///
/// Requires: the solid is bounded, closed, and each of its faces has closed
///           loops. `names`: of the parts that faces are of.
SolidData data_of(const Solid& solid, const std::vector<std::string>& names);

/// The solid that the data are, in the table of `with` as by to_solid(solid,
/// with). The faces are of `part`, and their polygons are the data's origins.
///
/// Requires: check_solid_data(data); the table's grid has no fewer bits than
///           the data's.
/// Exact:    yes.
/// Errors:   kNotPlanar (a vertex is not on the plane of its face, or of its
///           edge); kRepeatedVertex (an edge of no length); kNotConvex (a face
///           lies on the other side of its loops); kOutOfRange (a vertex is
///           beyond the grid); kOpen (edges that do not cancel). With the
///           number of the face. That the surface does not cross itself is not
///           looked at.
/// Cost:     linear, and a sort of the edges.
Result<Solid> to_solid(const SolidData& data, const Solid& with,
                       std::int32_t part = 0);

/// The same in a table of its own.
Result<Solid> to_solid(const SolidData& data, std::int32_t part = 0);

}  // namespace halfspace::fast
