#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <vector>

#include "halfspace/span.hpp"

namespace halfspace::ref {

using halfspace::merge_case;

/// The unlit segments of one scan line, from left to right, no two of them
/// overlapping (S4.8): F2B's DS[i], whose elements have Min and Max, here
/// `first` and `last`, and whose Link is the list's own.
using UnlitList = std::list<Span>;

/// Called for each run of pixels that becomes lit.
using PaintSegment = std::function<void(Span)>;

/// F2B's Merge-segment: paints what the object segment covers of the unlit
/// one, takes it out of the list, and advances (S4.7).
///
/// Requires: `unlit` in `list`, `object` not the end of its segments.
/// Keeps:    the list is sorted, its segments are not empty and not
///           overlapping.
void merge_segment(std::vector<Span>::const_iterator& object, UnlitList& list,
                   UnlitList::iterator& unlit, const PaintSegment& paint);

/// The result for a line: its newly lit pixels, and those still unlit.
struct Merged {
  std::vector<Span> lit;
  std::vector<Span> unlit;
  friend bool operator==(const Merged&, const Merged&) = default;
};

/// F2B's Merge, of the object segments and the unlit segments of a line
/// (S4.8): lit is their intersection, unlit is what that leaves.
///
/// Requires: either list is sorted, without overlap.
/// Shape:    either result too; no segment is empty.
/// Cost:     linear in the number of segments.
Merged merge(const std::vector<Span>& objects, const std::vector<Span>& unlit);

/// F2B's dynamic screen: the unlit segments of every scan line (S4.8).
class DynamicScreen {
 public:
  /// An unlit screen. Units: pixels.
  DynamicScreen(std::int32_t width_px, std::int32_t height_px);

  /// Merges the object segments with the unlit segments of the line, and
  /// paints what becomes lit.
  ///
  /// Requires: `objects` as in the free function merge().
  void merge(std::int32_t line, const std::vector<Span>& objects,
             const PaintSegment& paint);

  /// Whether every pixel is lit: then no more fragments are needed.
  bool full() const { return lines_with_unlit_ == 0; }

 private:
  std::vector<UnlitList> lines_;
  std::int32_t lines_with_unlit_ = 0;
};

}  // namespace halfspace::ref
