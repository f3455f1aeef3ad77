#pragma once

#include <utility>
#include <vector>

#include "definition/definition.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {

/// The faces of a fast solid in convex polygons, exactly: each face cut into
/// strips at its corners.
std::vector<std::vector<definition::Point>> polygons_of(
    const fast::Solid& solid);

/// Six times its volume, from its edges alone.
definition::Fraction volume6_of(const fast::Solid& solid);

/// The fast library's booleans, as the laws see them (both.hpp).
struct FastSolids {
  using Solid = fast::Solid;

  // S6
  static Solid to_solid(const GridSolid& solid) {
    return fast::to_solid(solid);
  }
  /// What is outside of a solid that is not empty.
  static Solid complement_of(const GridSolid& solid) {
    return fast::complement(fast::to_solid(solid));
  }
  static Solid boolean(BooleanOp operation, const Solid& a, const Solid& b) {
    return fast::boolean(operation, a, b);
  }
  static bool is_solid(const Solid& solid) {
    return fast::check_operand(solid).has_value();
  }
  static Solid resolve(const Solid& solid) {
    return fast::resolve(solid).solid;
  }
  static std::vector<std::vector<definition::Point>> polygons_of(
      const Solid& solid) {
    return halfspace::polygons_of(solid);
  }
  static bool is_closed(const Solid& solid) {
    return fast::bad_edges(solid).empty();
  }
  static definition::Fraction volume6(const Solid& solid) {
    return volume6_of(solid);
  }
};

}  // namespace halfspace
