#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "halfspace/csg/scaled.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::csg {

/// Polygons that hang together by edges.
struct Component {
  std::size_t polygons = 0;
  double volume = 0;  ///< signed; 0 where it is not closed
  /// The number of handles, where every edge has exactly two polygons that run
  /// along it in opposite directions.
  std::optional<std::int64_t> genus;
};

/// What can be measured of a surface, in doubles. Units: grid steps, which
/// never take a double out of its range; `in_units` gives them in model units.
struct Measures {
  Unit unit{2, 0};
  double area = 0;
  std::array<double, 3> least{};  ///< of the box round the polygons
  std::array<double, 3> most{};
  double volume = 0;                  ///< that the surface winds round
  std::array<double, 3> centre{};     ///< of that; of the area where it is 0
  std::vector<Component> components;  ///< by their first polygons

  Scaled in_units(double steps, int power = 1) const {
    return {steps, unit, power};
  }
};

/// Measures a scene. The volume, its centre and those of the components mean
/// something where the surface is closed.
///
/// Components: polygons are neighbours where an edge of one is the reverse of
///   an edge of the other; where several are, they are paired in the order of
///   their ids. The vertices of a component are counted for each fan of
///   polygons round them, so a component that touches itself at a vertex has
///   the genus that it would have apart.
/// Exact: no; sums in doubles, from the middle of the box.
/// Cost:  n log n in the corners.
Measures measures_of(const Scene& scene);

}  // namespace halfspace::csg
