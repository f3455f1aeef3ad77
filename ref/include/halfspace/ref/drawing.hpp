#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/drawing.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// A part of an edge with one number of layers in front of it (S9.5).
/// Units: pixels for the image.
struct DrawnInterval {
  EdgeClass edge_class = EdgeClass::kCrease;
  std::int32_t layers = 0;  ///< 0: it is visible
  Point edge_from;          ///< the edge's ends in space
  Point edge_to;
  Rational from_share;  ///< the shares of the edge at which it begins and ends
  Rational to_share;
  ImagePoint from;
  ImagePoint to;
};

/// A straight stroke of the pen (S9.6), `from` before `to` by x, then y.
struct DrawnStroke {
  EdgeClass edge_class = EdgeClass::kCrease;
  std::int32_t layers = 0;
  ImagePoint from;
  ImagePoint to;
};

/// A drawing (S9): intervals in the order of their edges' ends, strokes in that
/// of their own.
struct Drawing {
  std::vector<DrawnInterval> intervals;
  std::vector<DrawnStroke> strokes;
  std::vector<bool> points_visible;  ///< by given point (S9.7)
};

/// The drawing of a scene (S9).
///
/// Every edge is cut wherever a plane of any polygon, side seen from the eye
/// or limit of the view meets it, and what is in front of the middle of each
/// part is counted.
/// Requires: as S9.8 says of clip planes; a closed scene where there is a cap.
/// Exact: yes.
/// Cost:  the cube of the number of polygons: small scenes.
Drawing draw(const Scene& scene, const Camera& camera,
             const DrawingOptions& options = {});

}  // namespace halfspace::ref
