#include "halfspace/ref/seen_areas.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <set>

namespace halfspace::ref {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
using Ray = std::array<Real, 3>;

Real real_of(const Rational& value) {
  const auto big = value.big();
  return Real(numerator(big).str()) / Real(denominator(big).str());
}

/// The ray of an image point (S4.3), from the eye.
Ray ray_through(const ImagePoint& at, const Camera& camera) {
  const auto component = [&](Int128 LatticeVector::*k) {
    return real_of(Rational(camera->s0.*k) - Rational(camera->eye.*k) +
                   at.x * Rational(camera->sx.*k) +
                   at.y * Rational(camera->sy.*k));
  };
  return {component(&LatticeVector::x), component(&LatticeVector::y),
          component(&LatticeVector::z)};
}

Real angle_between(const Ray& u, const Ray& v) {
  const Real x = u[1] * v[2] - u[2] * v[1];
  const Real y = u[2] * v[0] - u[0] * v[2];
  const Real z = u[0] * v[1] - u[1] * v[0];
  const Real cosine = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  return atan2(sqrt(Real(x * x + y * y + z * z)), cosine);
}

/// The area of the triangle in which three rays meet the unit sphere, from its
/// sides (L'Huilier's theorem).
Real triangle_on_sphere(const Ray& u, const Ray& v, const Ray& w) {
  const Real a = angle_between(v, w);
  const Real b = angle_between(w, u);
  const Real c = angle_between(u, v);
  const Real s = (a + b + c) / 2;
  const Real square = tan(Real(s / 2)) * tan(Real((s - a) / 2)) *
                      tan(Real((s - b) / 2)) * tan(Real((s - c) / 2));
  return square > 0 ? Real(4 * atan(sqrt(square))) : Real(0);
}

/// The solid angle of a key: of the triangles from the image's corner over all
/// arcs, those that turn the other way less.
double solid_angle_of_key(const std::vector<MapArc>& map, std::int32_t key,
                          const Camera& camera) {
  const Ray corner = ray_through({0, 0}, camera);
  Real sum = 0;
  for (const MapArc& arc : map) {
    if ((arc.left == key) == (arc.right == key)) continue;
    const int turn = sign(arc.from.x * arc.to.y - arc.from.y * arc.to.x);
    const Real angle = triangle_on_sphere(corner, ray_through(arc.from, camera),
                                          ray_through(arc.to, camera));
    sum += (arc.right == key ? turn : -turn) * angle;
  }
  return sum.convert_to<double>();
}

}  // namespace

std::vector<SeenArea> seen_areas(const std::vector<MapArc>& map,
                                 const Camera& camera) {
  std::set<std::int32_t> keys;
  for (const MapArc& arc : map) keys.insert({arc.left, arc.right});
  keys.erase(kOutsideKey);
  std::vector<SeenArea> areas;
  for (const std::int32_t key : keys) {
    const double solid_angle =
        camera->perspective ? solid_angle_of_key(map, key, camera) : 0;
    areas.push_back({key, area_of_key(map, key), solid_angle});
  }
  return areas;
}

}  // namespace halfspace::ref
