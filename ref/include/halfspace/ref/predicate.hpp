#pragma once

#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/plane.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/ref/rational.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// A point of space. Units: grid steps.
struct Point {
  Rational x, y, z;
  friend bool operator==(const Point&, const Point&) = default;
};

/// Lexicographic order of points: by x, then y, then z.
bool operator<(const Point& p, const Point& q);

/// The oriented plane h(p) = a x + b y + c z + d (S1.4).
struct Plane {
  Rational a, b, c, d;
};

/// A polygon, or what is left of one after cuts (S2.2).
///
/// Edge `k` runs from vertex `k` to vertex `k + 1`, cyclically. A whole
/// polygon is the fragment whose edges are all its own.
struct Fragment {
  PolygonId source = 0;
  std::vector<EdgeName> edges;
  std::vector<Point> vertices;  ///< as many as edges
};

/// The point of the grid, as a point of space.
Point to_point(const GridPoint& p);

/// The polygon `id` of the scene as a fragment, uncut.
Fragment whole(const Scene& scene, PolygonId id);

/// The plane through a polygon's vertices: its normal is (p1-p0) x (p2-p0) at
/// the first corner that is not straight (S1.4).
/// Requires: not all vertices on one line.
Plane plane_of(const std::vector<Point>& vertices);

/// The planes of all polygons of the scene, by polygon id (S1.4).
std::vector<Plane> planes_of(const Scene& scene);

/// h(p) (S1.4).
Rational value_at(const Plane& plane, const Point& p);

/// The side of `plane` that holds `p` (S1.5).
Side side_of(const Plane& plane, const Point& p);

/// The side of `plane` that holds the camera's eye; for an eye at infinity,
/// the side towards which its direction points (S4.2).
Side side_of_eye(const Plane& plane, const Camera& camera);

/// The fragment against the plane, by the signs at its vertices (S2.1).
Relation relation(const Fragment& fragment, const Plane& plane);

/// The fragment by names alone (S2.2).
FragmentName name_of(const Fragment& fragment);

}  // namespace halfspace::ref
