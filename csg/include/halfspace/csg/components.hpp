#pragma once

#include <vector>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::csg {

/// The connected parts of a bounded solid's interior, each with the surfaces of
/// its cavities, by their first faces. Parts that only touch are apart.
///
/// Keeps: table, planes and points; faces, but that those in several parts are
///        divided, in their order, with where they came from.
/// Exact: yes.
/// Cost:  n log n; a boolean for each cavity and part whose box is around its
///        own, if there are several such parts.
std::vector<fast::Solid> components_of(const fast::Solid& solid);

/// A point of its interior. Units: model units.
/// Requires: the solid is bounded and not empty.
Numbers3 point_within(const fast::Solid& solid);

/// The component whose interior has the point; an empty solid if none has.
fast::Solid component_at(const fast::Solid& solid, const Numbers3& point);

}  // namespace halfspace::csg
