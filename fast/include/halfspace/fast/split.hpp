#pragma once

#include "halfspace/fast/predicate.hpp"

namespace halfspace::fast {

/// The two parts of a fragment that a plane cuts.
struct SplitResult {
  Fragment positive;
  Fragment negative;
};

/// Cuts `fragment` along the plane of polygon `splitter` (S2.3; FAG83
/// sec. 2.2.1).
///
/// Requires: relation(...) == Relation::kSpanning.
/// Shape:    n edges in; n + 4 - k out over both parts, k of the vertices
///           lying on the plane (0, 1 or 2).
/// Keeps:    source, and the order round the boundary. The new edge of either
///           part is the splitter's.
/// Exact:    yes: signs are decided, vertices approximated with their errors.
SplitResult split(const Scene& scene, const Fragment& fragment,
                  PolygonId splitter, FilterStats& stats);

}  // namespace halfspace::fast
