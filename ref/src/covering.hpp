#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/ref/predicate.hpp"
#include "halfspace/scene.hpp"

/// Coverage and depth as affine functions of the image point (S4.5, S5.3): what
/// the z-buffer and the visible map decide by.
namespace halfspace::ref {

/// A vector of space, or a homogeneous point without its last coordinate.
/// Units: lattice steps.
struct Vector {
  Rational x, y, z;
};

inline Vector operator-(const Vector& u, const Vector& v) {
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}

inline Rational determinant(const Vector& u, const Vector& v, const Vector& w) {
  return u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) +
         u.z * (v.x * w.y - v.y * w.x);
}

inline Vector to_vector(const LatticeVector& v) { return {v.x, v.y, v.z}; }

/// A function value + x dx + y dy of the image point (x, y).
struct Affine {
  Rational value, dx, dy;
};

inline Affine operator*(const Rational& scale, const Affine& f) {
  return {scale * f.value, scale * f.dx, scale * f.dy};
}
inline Affine operator-(const Affine& f, const Affine& g) {
  return {f.value - g.value, f.dx - g.dx, f.dy - g.dy};
}

/// The camera in rationals, with the point s of the image as the affine
/// function s0 + x sx + y sy (S4.1).
struct Eye {
  explicit Eye(const Camera& camera)
      : perspective(camera->perspective),
        eye(to_vector(camera->eye)),
        s0(to_vector(camera->s0)),
        sx(to_vector(camera->sx)),
        sy(to_vector(camera->sy)),
        near(camera->near) {}

  bool perspective;
  Vector eye, s0, sx, sy;
  std::optional<std::int64_t> near;
};

/// A polygon prepared for its pixels.
struct Covering {
  /// The sample is covered where all of these are positive (S4.5).
  std::vector<Affine> insides;
  /// The greater, the nearer: 1/t less 1 in perspective, else -t (S5.3).
  Affine nearness;
};

/// The corners of a polygon of the scene. Units: lattice steps.
std::vector<Vector> lattice_corners(const Scene& scene, PolygonId id);

/// The polygon as its pixels need it; nothing if it covers none: its plane
/// contains the eye, or it is seen from behind and culled.
std::optional<Covering> covering_of(const std::vector<Vector>& corners,
                                    const Plane& plane, const Eye& eye,
                                    bool cull);

}  // namespace halfspace::ref
