#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/scene.hpp"

namespace halfspace::csg {

/// The points of a scene in order, each once, and by vertex the place of its
/// own among them.
struct PointRanks {
  std::vector<GridPoint> points;
  std::vector<std::uint32_t> of_vertex;
};

/// Cost: a sort of the vertices.
PointRanks point_ranks(const std::vector<GridPoint>& vertices);

}  // namespace halfspace::csg
