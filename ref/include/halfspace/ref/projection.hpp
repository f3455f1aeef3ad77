#pragma once

#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/ref/predicate.hpp"

namespace halfspace::ref {

/// Where a camera shows the points of space (S4.1), as affine functions of
/// the point.
///
/// With the eye e, every point p has camera coordinates X, Y and t:
///   in perspective    p = e + X sx + Y sy + t (s0 - e),
///   else              p = s0 + X sx + Y sy - t eye,
/// and t is the ray parameter of S4.3. It is shown at the image point
/// (X/t, Y/t) in perspective, (X, Y) else: at (x/w, y/w), where w is t, or 1.
/// The functions here are these times one common positive number.
struct Projection {
  Plane x, y, w;
  /// The image, and what is beyond the near distance: the points that are on
  /// the positive side of all of these, and no others, can be seen (S4.3).
  std::vector<Plane> view_volume;
};

/// The projection of a camera (S4.1).
///
/// Exact: yes: by Cramer's rule, without the division.
Projection projection_of(const Camera& camera);

/// The part of the fragment that is in the view volume, boundary included, or
/// a fragment without vertices if that has no area (S4.6).
///
/// The names of the edges that clipping makes mean nothing.
Fragment clip(Fragment fragment, const Projection& projection);

/// A point of the image. Units: pixels.
struct ImagePoint {
  Rational x, y;
};

/// The image of a point.
/// Requires: p in the view volume or on its boundary, and not the eye.
ImagePoint image_of(const Point& p, const Projection& projection);

}  // namespace halfspace::ref
