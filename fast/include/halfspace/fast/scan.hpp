#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/span.hpp"

namespace halfspace::fast {

/// An object segment: the pixels of one scan line that a fragment covers
/// (S4.6; F2B's [I, J]). Units: pixels.
struct ObjectSegment {
  std::int32_t line = 0;
  Span span;
  friend bool operator==(const ObjectSegment&, const ObjectSegment&) = default;
};

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
                                        FilterStats& stats);

}  // namespace halfspace::fast
