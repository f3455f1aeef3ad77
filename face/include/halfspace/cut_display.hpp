#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "halfspace/api.hpp"
#include "halfspace/display.hpp"
#include "halfspace/feed_order.hpp"
#include "halfspace/mesh.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

/// How much of a polygon is seen (S7.7): the doubles nearest to the exact
/// areas.
struct SeenArea {
  std::int32_t polygon = 0;  ///< kBackground: where nothing is seen
  double area_px = 0;        ///< square pixels
  double solid_angle = 0;    ///< steradians; 0 in a parallel view
};

/// What is displayed, cut so that an order of triangles needs no depth buffer
/// (S3.8): the same for every view, for a renderer of one's own.
struct VertexFeed {
  std::vector<Point> positions;        ///< within a few ulps where cut
  std::vector<std::int32_t> polygons;  ///< by vertex, that of the display
};

/// A display's polygons, cut by the planes of each other: what is asked of the
/// parts, and not of pictures. All of it may be asked from several threads.
///
/// Units:  as of Display.
/// Cost:   of making it n log n, of n polygons.
/// Source: S3.8, S7 of spec/, with the papers that they name.
class HALFSPACE_API CutDisplay {
 public:
  /// Requires: the display stays where it is, unchanged, as long as this one is
  ///           used. Error: kStopped (by the options' progress).
  static Result<CutDisplay> of(const Display& display,
                               const WorkOptions& options = {});

  CutDisplay(CutDisplay&&) noexcept;
  CutDisplay& operator=(CutDisplay&&) noexcept;
  ~CutDisplay();

  /// How much of each polygon that is seen is, the background first, then by
  /// polygon. Exact: the doubles nearest to it. Cost: some 100 us for each edge
  /// that is seen.
  /// Errors: those of Display::camera(); kOutOfRange (clip planes, which areas
  ///         do not have; too much to be seen).
  Result<std::vector<SeenArea>> seen_areas(const View& view = {}) const;

  /// Vertices for a graphics card, the same for every view.
  VertexFeed vertex_feed() const;
  /// The triangles of a view, three indices each, in an order in which none
  /// hides one before it, or one after it. Exact. What is culled or clipped is
  /// for the card to leave out. Cost: that of the triangles.
  /// Errors: those of Display::camera().
  Result<std::vector<std::uint32_t>> feed_indices(
      const View& view, FeedOrder order = FeedOrder::kBackToFront) const;

 private:
  struct State;
  explicit CutDisplay(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace halfspace
