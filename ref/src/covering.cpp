#include "covering.hpp"

#include "vector.hpp"

namespace halfspace::ref {
namespace {

/// A plane's value at the eye, P(e), and at the image point s, P(s) (S4.2).
/// Units: grid steps, times 2^8.
struct Seen {
  Rational eye;
  Affine image;
};
Seen seen(const Plane& plane, const Camera& camera) {
  const auto along = [&plane](const LatticeVector& v) {
    return dot(normal_of(plane), to_point(v));
  };
  const Rational offset = Rational(1 << kLatticeBits) * plane.d;
  return {
      camera->perspective ? along(camera->eye) + offset : along(camera->eye),
      {along(camera->s0) + offset, along(camera->sx), along(camera->sy)}};
}

}  // namespace

std::optional<Covering> covering_of(const Fragment& polygon,
                                    const Camera& camera, bool cull) {
  const Plane plane = plane_of(polygon.vertices);
  const Seen support = seen(plane, camera);
  const int g = sign(support.eye);
  if (g == 0 || (cull && g < 0)) return std::nullopt;
  Covering covering;
  for (std::size_t k = 0; k < polygon.vertices.size(); ++k) {
    const Point& p = polygon.vertices[k];
    const Point& q = polygon.vertices[(k + 1) % polygon.vertices.size()];
    const Seen edge = seen(
        plane_through(cross(normal_of(plane), difference(q, p)), p), camera);
    covering.insides.push_back(
        Rational(g) * (support.eye * edge.image - edge.eye * support.image));
  }
  if (camera->near) {
    const Rational k = *camera->near;
    const Rational unit = 1 << kNearBits;
    const Affine at_eye = {support.eye, 0, 0};
    covering.insides.push_back(Rational(g) *
                               (camera->perspective
                                    ? (unit - k) * at_eye + k * support.image
                                    : unit * support.image - k * at_eye));
  }
  // 1/t - 1 = -P(s) / P(e) in perspective, else -t = -P(s) / P(e).
  covering.nearness = Rational(-1) / support.eye * support.image;
  return covering;
}

int sign_beside(const Affine& f, const ImagePoint& p, const Rational& dx,
                const Rational& dy) {
  if (const int s = sign(f.value + p.x * f.dx + p.y * f.dy)) return s;
  return sign(dx * f.dx + dy * f.dy);
}

}  // namespace halfspace::ref
