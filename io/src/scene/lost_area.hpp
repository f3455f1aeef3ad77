#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "halfspace/io/import.hpp"
#include "halfspace/io/mesh.hpp"

namespace halfspace::io {

/// The error of a mesh most of whose polygons rounding takes (S1.7), or nothing
/// where it keeps as many as it takes.
///
/// Requires: `kept` says by face whether a polygon of the scene came of it.
/// Errors:   kOutOfRange; index and message name the polygon that reaches
///           farthest.
/// Exact:    yes: whether a face had an area is decided on its exact numbers.
std::optional<Error> lost_area_error(const Mesh& mesh,
                                     const std::vector<bool>& kept,
                                     const ImportReport& report);

}  // namespace halfspace::io
