#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/scene.hpp"

namespace halfspace::csg {

/// The volume that closed polygons wind round, about: in doubles. The corners
/// of polygon `p` are `corners[first_corner[p]]` up to but not including
/// `corners[first_corner[p + 1]]`.
double about_volume(const std::vector<std::array<double, 3>>& vertices,
                    const std::vector<std::uint32_t>& first_corner,
                    const std::vector<VertexId>& corners);

/// The volume that a closed scene winds round, in model units: a decimal, or a
/// fraction such as `1/3` where no decimal is it.
/// Exact: yes.
std::string exact_volume(const Scene& scene);

}  // namespace halfspace::csg
