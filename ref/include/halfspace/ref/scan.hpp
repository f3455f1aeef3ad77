#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/ref/predicate.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/span.hpp"

namespace halfspace::ref {

/// An object segment: the pixels of one scan line that a fragment covers
/// (S4.6; F2B's [I, J]). Units: pixels.
struct ObjectSegment {
  std::int32_t line = 0;
  Span span;
  friend bool operator==(const ObjectSegment&, const ObjectSegment&) = default;
};

/// The pixels whose samples the fragment covers (S4.5), line by line from the
/// top (S4.6): the sweep of an active edge table (AET) that F2B takes from
/// Foley and van Dam.
///
/// A fragment seen edge-on, one that contains the eye, and one at or before
/// the near distance cover nothing.
/// Shape: a fragment is convex, so there is at most one segment a line.
/// Exact: yes.
/// Ties:  the sample is right of the pixel's centre by e and, by far less,
///        below it by e * e (S4.4). So an edge through the centre has it on
///        its right; a horizontal edge through it has it below.
/// Cost:  a few rational operations an edge and a line.
std::vector<ObjectSegment> scan_convert(const Fragment& fragment,
                                        const Projection& projection);

}  // namespace halfspace::ref
