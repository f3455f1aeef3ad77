#pragma once

#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/fast/simd.hpp"

namespace halfspace::fast {

/// The pixels whose samples the fragment covers (S4.5), line by line from the
/// top (S4.6): as render() finds them, on a screen of its own.
///
/// A fragment seen edge-on, one that contains the eye, and one at or before
/// the near distance cover nothing.
/// Shape: a fragment is convex, so there is at most one segment a line.
/// Exact: yes: eight lines at a time in doubles with bounds, in place of an
///        active edge table; exact image lines where a bound touches a sample.
/// Cost:  one screen; render() shares one among all fragments.
std::vector<ObjectSegment> scan_convert(const Scene& scene,
                                        const Fragment& fragment,
                                        const Camera& camera,
                                        FilterStats& stats,
                                        SimdLevel simd = SimdLevel::kBest);

/// The same of a fragment of the scene's tree, which free planes may have cut.
std::vector<ObjectSegment> scan_convert(const Scene& scene, const BspTree& tree,
                                        const TreeFragment& fragment,
                                        const Camera& camera,
                                        FilterStats& stats);

}  // namespace halfspace::fast
