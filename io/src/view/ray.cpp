#include "halfspace/io/ray.hpp"

#include <array>
#include <cmath>

#include "halfspace/big_integer.hpp"
#include "halfspace/io/number.hpp"
#include "view/fraction.hpp"

namespace halfspace::io {
namespace {

Integer to_integer(const RayInteger& words) {
  const bool negative = words.back() >> 63 != 0;
  Integer value = negative ? -1 : 0;
  for (std::size_t k = words.size(); k-- > 0;) {
    value *= Integer(1) << 64;
    value += words[k];
  }
  return value;
}

/// A lattice step in model units.
Fraction lattice_step(const Unit& unit) {
  return grid_step(unit) / Fraction(Integer(1) << kLatticeBits);
}

Fraction fraction_of(const RayHit& hit) {
  return Fraction(to_integer(hit.numerator), to_integer(hit.denominator));
}

/// The double nearest to the fraction, ties to even: 53 digits and more from a
/// division, the last one set where there is a rest.
double nearest(const Fraction& value) {
  if (value == 0) return 0;
  Integer over = abs(numerator(value));
  Integer under = denominator(value);
  const int size = static_cast<int>(msb(over)) - static_cast<int>(msb(under));
  const int shift = 66 - size;
  if (shift > 0) {
    over <<= static_cast<unsigned>(shift);
  } else {
    under <<= static_cast<unsigned>(-shift);
  }
  Integer quotient = over / under;
  if (quotient * under != over) quotient |= 1;
  // 66 or 67 bits; the lowest 12 do no more than say how to round.
  const auto high = static_cast<std::uint64_t>(quotient >> 12);
  const bool rest = (quotient & 0xfff) != 0;
  // Of 54 or 55 bits: made 55, a bit for a half and one for the rest.
  const double result =
      std::ldexp(static_cast<double>(high << 2 | (rest ? 1 : 0)), 10 - shift);
  return value < 0 ? -result : result;
}

/// The double nearest to the root of a fraction that is not negative.
double nearest_root(const Fraction& square) {
  if (square == 0) return 0;
  Integer over = numerator(square);
  const Integer under = denominator(square);
  int shift = 0;
  const int missing =
      132 - static_cast<int>(msb(over)) + static_cast<int>(msb(under));
  if (missing > 0) {
    shift = (missing + 1) / 2;
    over <<= static_cast<unsigned>(2 * shift);
  }
  // A rest is a last digit more, which is far below what rounding sees.
  const Integer root = sqrt(Integer(over / under));
  const bool is_all = root * root * under == over;
  return nearest(Fraction(Integer(root * 2 + (is_all ? 0 : 1)),
                          Integer(1) << static_cast<unsigned>(shift + 1)));
}

/// A number of model units in lattice steps.
Fraction lattice_of(double value, const Unit& unit) {
  return fraction_of(number_of(value)) / lattice_step(unit);
}

bool all_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A point or a direction on the lattice, and how far that moved it.
struct Rounded {
  LatticeVector vector;
  double move = 0;
};

Result<Rounded> to_lattice(const glm::dvec3& v, const Unit& unit) {
  Rounded result;
  Int128* const to[] = {&result.vector.x, &result.vector.y, &result.vector.z};
  const Integer most = Integer(1) << 100;
  for (int a = 0; a < 3; ++a) {
    const Fraction exact = lattice_of(v[a], unit);
    const Integer whole = rounded(exact);
    if (abs(whole) > most) {
      return Error{ErrorCode::kOutOfRange,
                   "a ray reaches farther than 64 times the range of the grid"};
    }
    *to[a] = to_int128(whole);
    const double off = nearest(Fraction(exact - whole));
    result.move = std::max(result.move, std::abs(off) / (1 << kLatticeBits));
  }
  return result;
}

}  // namespace

Result<RoundedRay> ray_between(const Scene& scene, const glm::dvec3& from,
                               const glm::dvec3& to, Reach reach) {
  if (!all_finite(from) || !all_finite(to))
    return Error{ErrorCode::kNotFinite, "a number of the ray is not finite"};
  const Result<Rounded> begin = to_lattice(from, scene.unit());
  if (!begin) return begin.error();
  const Result<Rounded> end = to_lattice(to, scene.unit());
  if (!end) return end.error();
  const LatticeVector& p = begin->vector;
  const LatticeVector& q = end->vector;
  const Result<Ray> ray = make_ray(
      {p, {q.x - p.x, q.y - p.y, q.z - p.z}, reach}, scene.grid_bits());
  if (!ray) return ray.error();
  return RoundedRay{*ray, std::max(begin->move, end->move)};
}

Result<RoundedRay> ray_along(const Scene& scene, const glm::dvec3& from,
                             const glm::dvec3& direction) {
  if (!all_finite(from) || !all_finite(direction))
    return Error{ErrorCode::kNotFinite, "a number of the ray is not finite"};
  const Result<Rounded> begin = to_lattice(from, scene.unit());
  if (!begin) return begin.error();
  const double longest = std::max(
      {std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  Result<Rounded> along = to_lattice(direction, scene.unit());
  if (!along || along->move > 0) {
    // The greatest power of two that the lattice holds.
    const int reach = scene.grid_bits() - 2 + kLatticeBits + kCameraRangeBits;
    int exponent = 0;
    std::frexp(longest, &exponent);
    Rounded scaled;
    const auto component = [&](double value) {
      const Number number = number_of(std::ldexp(value, -exponent));
      return to_int128(rounded(fraction_of(number) * power(2, reach)));
    };
    scaled.vector = {component(direction.x), component(direction.y),
                     component(direction.z)};
    along = scaled;
  }
  const Result<Ray> ray =
      make_ray({begin->vector, along->vector, Reach::kRay}, scene.grid_bits());
  if (!ray) return ray.error();
  return RoundedRay{*ray, begin->move};
}

double distance_of(const RayHit& hit, const Ray& ray, const Unit& unit) {
  const Fraction t = fraction_of(hit);
  const auto square = [](Int128 value) -> Integer {
    const auto big = to_big<Integer>(value);
    return big * big;
  };
  const LatticeVector& d = ray->direction;
  const Fraction step = lattice_step(unit);
  return nearest_root(t * t * step * step *
                      Integer(square(d.x) + square(d.y) + square(d.z)));
}

double parameter_of(const RayHit& hit) { return nearest(fraction_of(hit)); }

std::string exact_parameter_of(const RayHit& hit) {
  return fraction_of(hit).str();
}

glm::dvec3 point_of(const RayHit& hit, const Ray& ray, const Unit& unit) {
  const Fraction t = fraction_of(hit);
  const Fraction step = lattice_step(unit);
  const auto at = [&](Int128 origin, Int128 along) {
    return nearest(Fraction(
        step * (to_big<Integer>(origin) + t * to_big<Integer>(along))));
  };
  return {at(ray->origin.x, ray->direction.x),
          at(ray->origin.y, ray->direction.y),
          at(ray->origin.z, ray->direction.z)};
}

PixelPoint pixel_point(const Scene& scene, const Camera& camera,
                       PolygonId polygon, std::int32_t i, std::int32_t j) {
  // In halves of lattice steps all is whole.
  using Vector = std::array<Integer, 3>;
  const auto vector = [](const LatticeVector& v, int factor) {
    return Vector{factor * to_big<Integer>(v.x), factor * to_big<Integer>(v.y),
                  factor * to_big<Integer>(v.z)};
  };
  const auto plus = [](const Vector& u, const Vector& v, int factor) {
    return Vector{u[0] + factor * v[0], u[1] + factor * v[1],
                  u[2] + factor * v[2]};
  };
  const auto dot = [](const Vector& u, const Vector& v) -> Integer {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  constexpr int kSteps = 2 << kLatticeBits;
  // The normal from the sum of the corners' turns: that of a convex polygon.
  const auto corners = scene.corners(polygon);
  const auto corner = [&](std::size_t k) {
    const GridPoint& p = scene.point(corners[k]);
    return Vector{Integer(p.x) * kSteps, Integer(p.y) * kSteps,
                  Integer(p.z) * kSteps};
  };
  Vector normal{};
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Vector u = plus(corner(k), corner(0), -1);
    const Vector v = plus(corner(k + 1), corner(0), -1);
    normal = plus(normal,
                  {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                   u[0] * v[1] - u[1] * v[0]},
                  1);
  }
  const CameraData& data = camera.data();
  const Vector s = plus(plus(vector(data.s0, 2), vector(data.sx, 1), 2 * i + 1),
                        vector(data.sy, 1), 2 * j + 1);
  const Vector eye = vector(data.eye, 2);
  const Vector origin = data.perspective ? eye : s;
  const Vector along =
      data.perspective ? plus(s, eye, -1) : plus(Vector{}, eye, -1);
  const Fraction t = Fraction(dot(normal, plus(corner(0), origin, -1))) /
                     Fraction(dot(normal, along));
  const Fraction step = lattice_step(scene.unit()) / 2;
  PixelPoint result;
  for (int a = 0; a < 3; ++a) {
    const auto k = static_cast<std::size_t>(a);
    result.point[a] = nearest(Fraction(step * (origin[k] + t * along[k])));
  }
  result.distance = nearest_root(t * t * step * step * dot(along, along));
  if (t < 0) result.distance = -result.distance;
  return result;
}

}  // namespace halfspace::io
