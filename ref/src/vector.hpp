#pragma once

#include "halfspace/camera.hpp"
#include "halfspace/ref/predicate.hpp"

/// Vectors are points: differences of points, normals of planes.
namespace halfspace::ref {

inline Point to_point(const LatticeVector& v) { return {v.x, v.y, v.z}; }

inline Point normal_of(const Plane& plane) {
  return {plane.a, plane.b, plane.c};
}

/// u - v.
inline Point difference(const Point& u, const Point& v) {
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}

inline Point cross(const Point& u, const Point& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

inline Rational dot(const Point& u, const Point& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

/// Whether the normals of two planes that are the same point set agree.
inline bool same_direction(const Plane& p, const Plane& q) {
  return sign(dot(normal_of(p), normal_of(q))) > 0;
}

/// The plane with this normal through `p`.
inline Plane plane_through(const Point& normal, const Point& p) {
  return {normal.x, normal.y, normal.z, -dot(normal, p)};
}

}  // namespace halfspace::ref
