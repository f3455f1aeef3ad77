#pragma once

#include "halfspace/ref/predicate.hpp"

namespace halfspace::ref {

/// The two parts of a fragment that a plane cuts.
struct SplitResult {
  Fragment positive;
  Fragment negative;
};

/// Cuts `fragment` along `plane`, which is called `splitter` (S2.3; FAG83
/// sec. 2.2.1).
///
/// Requires: relation(fragment, plane) == Relation::kSpanning.
/// Shape:    n edges in; n + 4 - k out over both parts, k of the vertices
///           lying on the plane (0, 1 or 2).
/// Keeps:    source, and the order round the boundary. The new edge of either
///           part is the splitter's.
/// Exact:    yes.
SplitResult split(const Fragment& fragment, const Plane& plane,
                  PolygonId splitter);

}  // namespace halfspace::ref
