#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/clip.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace {

/// What makes an edge a line of a drawing (S9.2), the first one that holds.
enum class EdgeClass : std::uint8_t {
  kSection,       ///< a polygon at it is marked as cut
  kBorder,        ///< one polygon is at it
  kSilhouette,    ///< all polygons at it are seen on one side of it
  kIntersection,  ///< two polygons pass through each other
  kCrease,        ///< two polygons meet at an angle, or more than two meet
  kGiven,         ///< no edge: a line that the options give (S9.7)
};
constexpr std::size_t kEdgeClassCount = 6;

/// A line that is drawn with a scene, in grid steps (S9.7).
struct GivenLine {
  GridPoint from;
  GridPoint to;
};

/// The unit of DrawingOptions::crease_cosine.
constexpr int kCosineBits = 30;

/// What a drawing depends on, beside scene and camera (S9).
struct DrawingOptions {
  bool cull = false;  ///< as ImageOptions::cull
  /// Two polygons make a crease if the cosine of the angle by which their
  /// planes turn is less than this times 2^-30: from -2^30 to 2^30, which is
  /// every angle but a flat one.
  std::int32_t crease_cosine = std::int32_t{1} << kCosineBits;
  /// Whether a polygon is a cut (S9.2), by id; empty: none is.
  std::vector<bool> cuts;
  /// What is drawn with the scene and hidden by it (S9.7), in its grid.
  std::vector<GivenLine> lines;
  bool edges = true;  ///< false: the given lines alone
  std::vector<GridPoint> points;
  /// Clip planes as make_clips() makes them (S9.8).
  std::vector<ClipPlane> clips;
  bool caps = false;  ///< whether clip planes have caps
  /// Whether clip planes take nothing of given lines and points away.
  bool whole = false;
};

}  // namespace halfspace
