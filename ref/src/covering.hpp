#pragma once

#include <optional>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/ref/predicate.hpp"
#include "halfspace/ref/projection.hpp"

/// What decides about polygons at points of the image: affine functions.
namespace halfspace::ref {

/// A function value + x dx + y dy of the image point (x, y).
struct Affine {
  Rational value, dx, dy;
};
inline Affine operator*(const Rational& scale, const Affine& f) {
  return {scale * f.value, scale * f.dx, scale * f.dy};
}
inline Affine operator+(const Affine& f, const Affine& g) {
  return {f.value + g.value, f.dx + g.dx, f.dy + g.dy};
}
inline Affine operator-(const Affine& f, const Affine& g) {
  return f + Rational(-1) * g;
}

/// What decides about a polygon at an image point.
struct Covering {
  std::vector<Affine> insides;  ///< all positive: it is covered (S4.5)
  Affine nearness;              ///< the greater, the nearer (S5.3)
};

/// The forms of a polygon; nothing if its plane holds the eye or it is culled.
std::optional<Covering> covering_of(const Fragment& polygon,
                                    const Camera& camera, bool cull);

/// The sign of a form right beside a point, in direction (dx, dy) from it.
int sign_beside(const Affine& f, const ImagePoint& p, const Rational& dx,
                const Rational& dy);

}  // namespace halfspace::ref
