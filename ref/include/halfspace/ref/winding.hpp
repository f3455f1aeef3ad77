#pragma once

#include "halfspace/bsp_tree.hpp"
#include "halfspace/ref/classify.hpp"

namespace halfspace::ref {

/// The winding number of the solid's surface around the points right beside
/// `p`, in the direction of the normal of `plane` (S6.2).
///
/// Requires: the surface is closed; of its faces only those in `plane` hold
///           `p`, and none of those has it on an edge.
/// Exact:    yes.
int winding_beside(const Solid& solid, const Point& p, const Plane& plane);

/// Whether a closed surface is that of a solid (S6.2): everywhere the winding
/// number is 0 right in front of it and 1 right behind it.
///
/// Requires: bad_edges(solid) is empty.
/// Exact:    yes. The answer does not depend on `options`.
bool is_solid(const Solid& solid, const BuildOptions& options = {});

/// The boundary of the points with winding number 1 or more (S6.7).
///
/// Requires: bad_edges(solid) is empty.
/// Shape:    fragments of the faces, in the order of these; every vertex that
///           lies on an edge is a corner there.
/// Ties:     of coplanar faces with one direction the first is taken.
/// Exact:    yes. The point set does not depend on `options`.
Solid resolve(const Solid& solid, const BuildOptions& options = {});

}  // namespace halfspace::ref
