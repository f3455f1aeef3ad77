#pragma once

#include <optional>

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// merge_faces(solid, rule) of a solid that is kept; nothing where that is the
/// solid itself, but for the corners that triangles begin with, which a mesh
/// does not show.
///
/// Cost: where there is nothing to merge, no copy.
std::optional<Solid> merged_copy(const Solid& solid, Merge rule);

}  // namespace halfspace::fast
