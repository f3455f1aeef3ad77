#pragma once

#include <string>

#include "image/engine.hpp"

namespace halfspace::tools {

/// What a tree of the fast library that cuts polygons is expected to take, as a
/// sentence; empty where that is little: less than a million fragments, or four
/// a polygon.
///
/// Trees of the same kind are made of a few of the polygons, and their growth
/// is carried on: right within a factor of two for triangles that cross each
/// other all over.
std::string tree_cost_warning(const Scene& scene, Library library,
                              const TreeRequest& request);

}  // namespace halfspace::tools
