#include "covering.hpp"

namespace halfspace::ref {
namespace {

/// The plane's function of the image point: P(s) (S4.5). The plane is given
/// by a point of it, and its normal.
struct Support {
  Vector point, normal;

  Rational along(const Vector& v) const {
    return normal.x * v.x + normal.y * v.y + normal.z * v.z;
  }
  Rational at(const Vector& p) const { return along(p - point); }
  Affine at_image(const Eye& eye) const {
    return {at(eye.s0), along(eye.sx), along(eye.sy)};
  }
};

/// Where the ray passes an edge from p to q: an affine function that is
/// positive where an eye on the positive side sees the image point on the
/// polygon's side of the edge (S4.5).
///
/// That is the sign of P(e) Q(s) - Q(e) P(s), whatever plane Q holds the edge:
/// the side of s against the plane through the edge and the eye.
Affine side_of_edge(const Vector& p, const Vector& q, const Eye& eye) {
  if (eye.perspective) {
    const Vector to_p = p - eye.eye;
    const Vector to_q = q - eye.eye;
    return {determinant(to_q, to_p, eye.s0 - eye.eye),
            determinant(to_q, to_p, eye.sx), determinant(to_q, to_p, eye.sy)};
  }
  const Vector edge = q - p;
  return {determinant(eye.eye, edge, eye.s0 - p),
          determinant(eye.eye, edge, eye.sx),
          determinant(eye.eye, edge, eye.sy)};
}

/// The near condition t > near / 2^16, multiplied out to be affine, for an
/// eye on the positive side (S4.5).
///
/// In perspective t = P(e) / (P(e) - P(s)), else t = P(s) / (n . eye).
/// Requires: eye.near.
Affine beyond_near(const Rational& plane_at_eye, const Affine& plane_at_image,
                   const Eye& eye) {
  const Rational unit = 1 << kNearBits;
  const Rational near = *eye.near;
  if (eye.perspective) {
    Affine f = near * plane_at_image;
    f.value += (unit - near) * plane_at_eye;
    return f;
  }
  Affine f = unit * plane_at_image;
  f.value -= near * plane_at_eye;
  return f;
}

}  // namespace

std::vector<Vector> lattice_corners(const Scene& scene, PolygonId id) {
  std::vector<Vector> corners;
  for (const VertexId vertex : scene.corners(id)) {
    const GridPoint& p = scene.point(vertex);
    const Rational scale = 1 << kLatticeBits;
    corners.push_back({scale * p.x, scale * p.y, scale * p.z});
  }
  return corners;
}

std::optional<Covering> covering_of(const std::vector<Vector>& corners,
                                    const Plane& plane, const Eye& eye,
                                    bool cull) {
  const Support support{corners[0], {plane.a, plane.b, plane.c}};
  const Rational plane_at_eye =
      eye.perspective ? support.at(eye.eye) : support.along(eye.eye);
  const int sigma = sign(plane_at_eye);
  if (sigma == 0 || (cull && sigma < 0)) return std::nullopt;

  Covering covering;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector& next = corners[(k + 1) % corners.size()];
    covering.insides.push_back(Rational(sigma) *
                               side_of_edge(corners[k], next, eye));
  }
  const Affine plane_at_image = support.at_image(eye);
  // Without a near distance the signs above leave out what is behind the eye.
  if (eye.near) {
    covering.insides.push_back(Rational(sigma) *
                               beyond_near(plane_at_eye, plane_at_image, eye));
  }
  // 1/t - 1 = -P(s) / P(e) in perspective, else -t = -P(s) / (n . eye).
  covering.nearness = Rational(-1) / plane_at_eye * plane_at_image;
  return covering;
}

}  // namespace halfspace::ref
