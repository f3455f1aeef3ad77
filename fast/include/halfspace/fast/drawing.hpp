#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/drawing.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// A line of a drawing in space (S9.1, S9.3).
struct DrawingEdge {
  EdgeClass edge_class = EdgeClass::kCrease;
  /// Its ends; -1 for an intersection, a section or a given line, whose ends
  /// are no vertices.
  VertexId from = -1;
  VertexId to = -1;
  /// The lowest polygon at it, and the next one, or -1: of an intersection the
  /// two that pass through each other.
  /// -1 at a given line, of which `other` is the number, and where caps meet.
  PolygonId polygon = 0;
  PolygonId other = -1;
  friend bool operator==(const DrawingEdge&, const DrawingEdge&) = default;
};

/// A point of a drawing. Units: pixels.
struct DrawingPoint {
  double x = 0;  ///< the nearest double to the exact coordinate
  double y = 0;
  friend bool operator==(const DrawingPoint&, const DrawingPoint&) = default;
};

/// A part of an edge with one number of layers in front of it (S9.5).
struct EdgeInterval {
  std::int32_t edge = 0;
  std::int32_t layers = 0;  ///< 0: it is visible
  /// The shares of the edge in space at which it begins and ends, from 0 at
  /// its first end to 1: the nearest doubles. An edge at which caps meet is all
  /// of its line within the box round the scene, one grid step larger on all
  /// sides, for this.
  double from_share = 0;
  double to_share = 1;
  DrawingPoint from;
  DrawingPoint to;
  friend bool operator==(const EdgeInterval&, const EdgeInterval&) = default;
};

/// What is seen of a given point (S9.7).
struct SeenPoint {
  bool visible = false;
  DrawingPoint at;  ///< where, if it is
  friend bool operator==(const SeenPoint&, const SeenPoint&) = default;
};

/// A straight stroke of the pen (S9.6).
struct Stroke {
  EdgeClass edge_class = EdgeClass::kCrease;
  std::int32_t layers = 0;  ///< the least along it; 0: it is visible
  DrawingPoint from;        ///< before `to` by x, then by y
  DrawingPoint to;
  /// The intervals that it is drawn for: `pieces[first_piece]` and the
  /// `piece_count - 1` after it.
  std::uint32_t first_piece = 0;
  std::uint32_t piece_count = 0;
  friend bool operator==(const Stroke&, const Stroke&) = default;
};

/// A drawing (S9).
///
/// Shape: intervals in the order of their edges and along them; strokes in that
///        of their ends.
struct Drawing {
  std::vector<DrawingEdge> edges;
  std::vector<EdgeInterval> intervals;
  std::vector<Stroke> strokes;
  std::vector<std::int32_t> pieces;  ///< numbers of intervals, by stroke
  std::vector<SeenPoint> points;     ///< by given point
  FilterStats decisions;
};

/// Limits of a drawing, so that one that is too large is an error in time.
struct DrawingLimits {
  /// An interval takes some 200 bytes.
  std::size_t most_intervals = 40'000'000;
};

/// The drawing of a scene (S9): its edges' visible and hidden parts, and the
/// strokes that show them.
///
/// Candidates for hiding an edge come from a bounding volume hierarchy over
/// the polygons in the camera's coordinates. Along an edge a polygon's sides
/// and plane are affine functions, so what it hides is an interval between
/// quotients of their values at the edge's two ends.
/// Requires: options.cuts has one entry a polygon, or none; given points fit
///           the scene's grid; with clip planes there are no given points, with
///           caps the scene is closed (S9.8).
/// Exact:    yes: filters in doubles, integers of fixed width behind them.
/// Errors:   kOutOfRange: more intervals than the limit; says how many.
/// Cost:     n log n, and for each edge the polygons that overlap it in the
///           image and are not behind it.
Result<Drawing> draw(const Scene& scene, const Camera& camera,
                     const DrawingOptions& options = {},
                     const DrawingLimits& limits = {});

}  // namespace halfspace::fast
