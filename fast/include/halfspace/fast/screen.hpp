#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "halfspace/fast/simd.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/span.hpp"

namespace halfspace::fast {

using halfspace::merge_case;

/// An object segment: the pixels of one scan line that a fragment covers
/// (S4.6; F2B's [I, J]). Units: pixels.
struct ObjectSegment {
  std::int32_t line = 0;
  Span span;
  friend bool operator==(const ObjectSegment&, const ObjectSegment&) = default;
};

/// F2B's dynamic screen (S4.8), for a scan-line renderer: which pixels are
/// unlit, and F2B's Merge, which lights object segments.
///
/// The screen is kept as tiles of 32 x 8 pixels, one bit each, and is merged by
/// the loops that render() merges with: a merge lights `object & unlit` and
/// leaves `unlit & ~object`, so that no list is changed and merge_case() is not
/// asked. Segments of several lines of a tile are merged together.
///
///     DynamicScreen screen(width_px, height_px);
///     for (each fragment, front to back) {
///       screen.merge(scan_convert(scene, fragment, camera, stats),
///                    fragment.source, paint);
///       if (screen.full()) break;
///     }
///
/// Pixels off the screen are never unlit: segments may reach beyond it.
/// A screen may be used by one thread at a time.
/// Source: F2B "The dynamic screen"; masks of tiles: GRE96.
class DynamicScreen {
 public:
  /// An unlit screen.
  /// Requires: 1 <= width_px, height_px <= 65,536.
  DynamicScreen(std::int32_t width_px, std::int32_t height_px,
                SimdLevel simd = SimdLevel::kBest);
  DynamicScreen(DynamicScreen&&) noexcept;
  DynamicScreen& operator=(DynamicScreen&&) noexcept;
  ~DynamicScreen();

  /// Makes every pixel unlit. Cost: one bit a pixel is written.
  void clear();

  /// Lights object segments, and gives what was unlit of them: for each
  /// segment, in their order, its longest runs from left to right. Valid until
  /// the screen is used again.
  ///
  /// A segment that ends before it begins is empty.
  /// Cost: a step for each tile that segments meet, and one for each run. Where
  ///       segments follow each other from line to line, the eight lines of a
  ///       tile take one step.
  std::span<const ObjectSegment> light(std::span<const ObjectSegment> objects);

  /// Lights the object segments of one polygon, and calls
  /// paint(line, lit, id) for every run of pixels that becomes lit.
  template <class Paint>
  void merge(std::span<const ObjectSegment> objects, PolygonId id,
             Paint&& paint) {
    for (const ObjectSegment& lit : light(objects)) {
      paint(lit.line, lit.span, id);
    }
  }

  /// The same for object segments of one line.
  template <class Paint>
  void merge(std::int32_t line, std::span<const Span> objects, PolygonId id,
             Paint&& paint) {
    for (const Span& span : objects) {
      const ObjectSegment object = {line, span};
      merge({&object, 1}, id, paint);
    }
  }

  /// The unlit segments of the line, from left to right, as long as they are;
  /// none for a line off the screen.
  std::vector<Span> unlit(std::int32_t line) const;

  /// Whether every pixel is lit: then no more fragments are needed.
  bool full() const;

 private:
  struct Tiles;
  std::unique_ptr<Tiles> tiles_;
};

}  // namespace halfspace::fast
