#pragma once

#include <vector>

#include "halfspace/span.hpp"

namespace halfspace::fast {

using halfspace::merge_case;

/// What became of a line: its newly lit pixels, and those still unlit.
struct Merged {
  std::vector<Span> lit;
  std::vector<Span> unlit;
  friend bool operator==(const Merged&, const Merged&) = default;
};

/// F2B's Merge, of the object segments and the unlit segments of a line
/// (S4.8): lit is their intersection, unlit is what that leaves.
///
/// No list is changed and there are no cases: either result is the
/// intersections of two sorted lists' segments. render() has words of bits in
/// their place, where it is `object & unlit` and `unlit & ~object`.
/// Requires: either list is sorted, without overlap.
/// Shape:    either result too; no segment is empty.
/// Cost:     linear in the number of segments.
Merged merge(const std::vector<Span>& objects, const std::vector<Span>& unlit);

}  // namespace halfspace::fast
