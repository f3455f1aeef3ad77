#pragma once

#include <memory>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::csg {

/// What merging a surface's faces in one plane comes to.
struct LeanSurface {
  /// No faces in one plane and of one colour have an edge in common, and no
  /// vertex lies within an edge.
  bool is_lean = false;
  /// Else, if all merged faces are convex: the solid of those, and by its
  /// polygon the one that its face notes.
  std::shared_ptr<const GridSolid> solid = nullptr;
  std::vector<PolygonId> polygons = {};
};

/// Merges the faces of a solid; `scene` is the one that it was made from.
LeanSurface lean_surface(fast::Solid solid, const Scene& scene);

}  // namespace halfspace::csg
