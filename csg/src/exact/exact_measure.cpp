#include "halfspace/csg/exact_measure.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "halfspace/csg/interval.hpp"
#include "halfspace/csg/surface.hpp"

namespace halfspace::csg {
namespace {

/// A fraction that is not reduced while sums are made.
struct Fraction {
  Integer numerator = 0;
  Integer denominator = 1;
};

Fraction operator+(const Fraction& a, const Fraction& b) {
  if (a.denominator == b.denominator)
    return {a.numerator + b.numerator, a.denominator};
  return {a.numerator * b.denominator + b.numerator * a.denominator,
          a.denominator * b.denominator};
}

Fraction reduced(Fraction value) {
  Integer divisor = gcd(value.numerator, value.denominator);
  if (value.denominator < 0) divisor = -divisor;
  if (divisor != 0) {
    value.numerator /= divisor;
    value.denominator /= divisor;
  }
  return value;
}

/// The sum, by pairs and pairs of pairs, so that few numbers get long.
Fraction sum_of(std::vector<Fraction> terms) {
  if (terms.empty()) return {};
  while (terms.size() > 1) {
    const std::size_t half = (terms.size() + 1) / 2;
    for (std::size_t i = 0; i + half < terms.size(); ++i)
      terms[i] = reduced(terms[i] + terms[i + half]);
    terms.resize(half);
  }
  return reduced(terms.front());
}

/// The triple product of a face's origin and the ends of an edge, over the
/// product of their denominators: six times the volume of a tetrahedron.
Fraction volume6_of(const Integers3& origin, const ExactPoint& a,
                    const ExactPoint& b) {
  return {dot(origin, cross(a.at, b.at)), a.below * b.below};
}

Fraction exact_volume6(const fast::Solid& solid) {
  ExactSurface surface(solid);
  std::vector<Fraction> terms;
  for (const fast::Face& face : solid.faces) {
    const Integers3 origin = surface.origin(face);
    for_edges(solid, face, [&](const fast::SolidEdge& edge) {
      const ExactPoint from = surface.point(edge.from);
      terms.push_back(volume6_of(origin, from, surface.point(edge.to)));
    });
  }
  return sum_of(std::move(terms));
}

/// Fractions: a face's area is |normal| / 2 times their sum over the `axis`th
/// coordinate of the normal, which is not 0.
std::vector<Fraction> area_terms(ExactSurface& surface, const fast::Face& face,
                                 std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Fraction> terms;
  for_edges(surface.solid(), face, [&](const fast::SolidEdge& edge) {
    const ExactPoint a = surface.point(edge.from);
    const ExactPoint& b = surface.point(edge.to);
    terms.push_back({a.at[u] * b.at[v] - a.at[v] * b.at[u], a.below * b.below});
  });
  return terms;
}

std::size_t first_axis(const Integers3& normal) {
  std::size_t axis = 0;
  while (normal[axis] == 0) ++axis;
  return axis;
}

std::string decimal_of(const Integer& digits, std::size_t places) {
  std::string text = Integer(abs(digits)).str();
  if (text.size() <= places) text.insert(0, places + 1 - text.size(), '0');
  if (places > 0) text.insert(text.size() - places, ".");
  return (digits < 0 ? "-" : "") + text;
}

/// A decimal where one is it, else a fraction.
std::string text_of(Fraction value) {
  value = reduced(std::move(value));
  Integer rest = value.denominator;
  std::size_t twos = 0, fives = 0;
  for (; rest % 2 == 0; rest /= 2) ++twos;
  for (; rest % 5 == 0; rest /= 5) ++fives;
  if (rest != 1) return value.numerator.str() + "/" + value.denominator.str();
  const std::size_t places = std::max(twos, fives);
  const Integer digits = value.numerator *
                         pow(Integer(2), static_cast<unsigned>(places - twos)) *
                         pow(Integer(5), static_cast<unsigned>(places - fives));
  return decimal_of(digits, places);
}

/// The double next to `value`(arithmetic) * factor: with more and more bits
/// until there is no doubt; exactly where that does not end.
template <class Value, class Exactly>
double nearest_of(const Scale& scale, const Integer& divisor,
                  const Value& value, const Exactly& exactly) {
  for (unsigned bits = 192; bits <= 1536; bits *= 2) {
    const IntervalArithmetic arithmetic(bits);
    const auto result = arithmetic.nearest(value(arithmetic), scale.numerator,
                                           scale.denominator * divisor);
    if (result) return *result;
  }
  return exactly();
}

using IntervalPoint = std::array<Interval, 3>;

IntervalPoint interval_point(const IntervalArithmetic& arithmetic,
                             const ExactPoint& point) {
  IntervalPoint result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = arithmetic.quotient(point.at[i], point.below);
  return result;
}

/// The integrals of 1, x_i, and x_i x_j over a solid times 6, 24 and 120.
struct Integrals {
  Interval one;
  std::array<Interval, 3> first;
  std::array<std::array<Interval, 3>, 3> second;
};

/// Adds the tetrahedron of the origin, the face's origin and an edge: with S
/// the sum of its corners, the integrals are det / 6, det S_i / 24 and det /
/// 120 (S_i S_j + the sum of v_i v_j over its corners).
void add_tetrahedron(const IntervalArithmetic& a, const IntervalPoint& o,
                     const IntervalPoint& u, const IntervalPoint& v,
                     Integrals& sum) {
  Interval det;
  IntervalPoint corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    det = det + a.product(o[i], a.product(u[j], v[k]) - a.product(u[k], v[j]));
    corners[i] = o[i] + u[i] + v[i];
  }
  sum.one = sum.one + det;
  for (std::size_t i = 0; i < 3; ++i) {
    sum.first[i] = sum.first[i] + a.product(det, corners[i]);
    for (std::size_t j = 0; j <= i; ++j) {
      const Interval products = a.product(corners[i], corners[j]) +
                                a.product(o[i], o[j]) + a.product(u[i], u[j]) +
                                a.product(v[i], v[j]);
      sum.second[i][j] = sum.second[i][j] + a.product(det, products);
    }
  }
}

/// About `shift`, a point near the solid.
Integrals integrals_of(const IntervalArithmetic& arithmetic,
                       ExactSurface& surface, const Integers3& shift) {
  Integrals sum;
  const auto moved = [&](const ExactPoint& p) {
    ExactPoint q = p;
    for (std::size_t i = 0; i < 3; ++i) q.at[i] -= shift[i] * p.below;
    return interval_point(arithmetic, q);
  };
  for (const fast::Face& face : surface.solid().faces) {
    const IntervalPoint origin = moved({surface.origin(face), 1});
    for_edges(surface.solid(), face, [&](const fast::SolidEdge& edge) {
      const IntervalPoint from = moved(surface.point(edge.from));
      add_tetrahedron(arithmetic, origin, from, moved(surface.point(edge.to)),
                      sum);
    });
  }
  return sum;
}

/// The moments, if this number of bits leaves no doubt; `last` accepts them as
/// they are.
std::optional<Moments> moments_with(unsigned bits, ExactSurface& surface,
                                    bool last) {
  const IntervalArithmetic a(bits);
  const Unit unit = surface.solid().unit;
  const Integers3 shift = surface.origin(surface.solid().faces.front());
  const Integrals m = integrals_of(a, surface, shift);
  if (a.holds_zero(m.one)) return std::nullopt;
  Moments result;
  const auto nearest = [&](const Interval& value, const Scale& scale,
                           double& to) {
    // Symmetric solids have zeros, of which no digits say so.
    if (a.holds_zero(value)) return true;
    const auto known = a.nearest(value, scale.numerator, scale.denominator);
    const auto middle =
        a.nearest({value.middle, 0}, scale.numerator, scale.denominator);
    if (!known && !last) return false;
    to = known ? *known : *middle;
    return true;
  };
  std::array<std::array<Interval, 3>, 3> about;
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval centre = a.divided(a.divided(m.first[i], m.one), Integer(4));
    if (!nearest(centre + a.integer(shift[i]), scale_of(unit, 1),
                 result.centroid[i]))
      return std::nullopt;
    for (std::size_t j = 0; j <= i; ++j) {
      // 120 times the integral of x_i x_j, less that at the centre.
      const Interval at_centre =
          a.divided(a.product(m.first[i], m.first[j]), m.one);
      about[i][j] = a.divided(m.second[i][j], Integer(120)) -
                    a.divided(at_centre, Integer(96));
      about[j][i] = about[i][j];
    }
  }
  const Interval trace = about[0][0] + about[1][1] + about[2][2];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Interval entry =
          i == j ? trace - about[i][i] : Interval{} - about[i][j];
      if (!nearest(entry, scale_of(unit, 5), result.inertia[i][j]))
        return std::nullopt;
    }
  }
  return result;
}

}  // namespace

std::string text_of(const Integer& numerator, const Integer& denominator) {
  return text_of(Fraction{numerator, denominator});
}

namespace {

/// The volume times 6, in cubic steps.
Interval volume6_within(const IntervalArithmetic& a, const fast::Solid& solid,
                        ExactSurface& surface) {
  Interval sum;
  for (const fast::Face& face : solid.faces) {
    const Integers3 origin = surface.origin(face);
    for_edges(solid, face, [&](const fast::SolidEdge& edge) {
      const ExactPoint from = surface.point(edge.from);
      const Fraction term = volume6_of(origin, from, surface.point(edge.to));
      sum = sum + a.quotient(term.numerator, term.denominator);
    });
  }
  return sum;
}

}  // namespace

int compare_volumes(const fast::Solid& a, const fast::Solid& b) {
  ExactSurface of_a(a), of_b(b);
  // A sum of fractions has as many digits as all of them.
  for (unsigned bits = 192; bits <= 1536; bits *= 2) {
    const IntervalArithmetic within(bits);
    const Interval more =
        volume6_within(within, a, of_a) - volume6_within(within, b, of_b);
    if (!within.holds_zero(more)) return more.middle.sign();
  }
  const Fraction u = exact_volume6(a), v = exact_volume6(b);
  return Integer(u.numerator * v.denominator - v.numerator * u.denominator)
      .sign();
}

double volume_of(const fast::Solid& solid) {
  const Scale scale = scale_of(solid.unit, 3);
  ExactSurface surface(solid);
  return nearest_of(
      scale, 6,
      [&](const IntervalArithmetic& a) {
        return volume6_within(a, solid, surface);
      },
      [&] {
        const Fraction exact = exact_volume6(solid);
        return nearest_double(exact.numerator * scale.numerator,
                              exact.denominator * scale.denominator * 6);
      });
}

std::string exact_volume_of(const fast::Solid& solid) {
  const Scale scale = scale_of(solid.unit, 3);
  const Fraction exact = exact_volume6(solid);
  return text_of({exact.numerator * scale.numerator,
                  exact.denominator * scale.denominator * 6});
}

double area_of(const fast::Solid& solid) {
  const Scale scale = scale_of(solid.unit, 2);
  ExactSurface surface(solid);
  const auto area = [&](const IntervalArithmetic& a) {
    Interval sum;
    for (const fast::Face& face : solid.faces) {
      const Integers3 normal = surface.normal(face);
      const std::size_t axis = first_axis(normal);
      Interval of_face;
      for (const Fraction& term : area_terms(surface, face, axis))
        of_face = of_face + a.quotient(term.numerator, term.denominator);
      const Interval length = a.root(dot(normal, normal));
      sum = sum + a.divided(a.product(of_face, length), normal[axis]);
    }
    return sum;
  };
  return nearest_of(scale, 2, area, [&] {
    // Rational and half-way between two doubles, or too close to decide.
    const IntervalArithmetic a(1536);
    return *a.nearest({area(a).middle, 0}, scale.numerator,
                      scale.denominator * 2);
  });
}

std::optional<std::string> exact_area_of(const fast::Solid& solid) {
  const Scale scale = scale_of(solid.unit, 2);
  ExactSurface surface(solid);
  std::vector<Fraction> terms;
  for (const fast::Face& face : solid.faces) {
    const Integers3 normal = surface.normal(face);
    const Integer square = dot(normal, normal);
    const Integer root = sqrt(square);
    // Roots of integers that are no squares are independent over the rationals
    // up to square factors, and areas are above 0: one is enough.
    if (root * root != square) return std::nullopt;
    const std::size_t axis = first_axis(normal);
    Fraction area = sum_of(area_terms(surface, face, axis));
    area.numerator *= root;
    area.denominator *= normal[axis];
    terms.push_back(std::move(area));
  }
  const Fraction exact = sum_of(std::move(terms));
  return text_of({exact.numerator * scale.numerator,
                  exact.denominator * scale.denominator * 2});
}

Moments moments_of(const fast::Solid& solid) {
  ExactSurface surface(solid);
  for (unsigned bits = 256; bits <= 1024; bits *= 2) {
    if (auto result = moments_with(bits, surface, false)) return *result;
  }
  return moments_with(2048, surface, true).value_or(Moments{});
}

namespace {

/// By axis a vertex where the coordinate is the least, and the greatest.
struct Extremes {
  std::array<ExactPoint, 3> low, high;
};

Extremes extremes_of(const fast::Solid& solid) {
  ExactSurface surface(solid);
  Extremes found;
  bool any = false;
  const auto less = [](const ExactPoint& a, const ExactPoint& b,
                       std::size_t i) {
    return a.at[i] * b.below < b.at[i] * a.below;
  };
  for (const fast::SolidEdge& edge : solid.edges) {
    const ExactPoint& p = surface.point(edge.from);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!any || less(p, found.low[i], i)) found.low[i] = p;
      if (!any || less(found.high[i], p, i)) found.high[i] = p;
    }
    any = true;
  }
  return found;
}

/// What `told` makes of each bound, a quotient.
template <class Told>
auto told_bounds(const fast::Solid& solid, const Told& told) {
  const Extremes found = extremes_of(solid);
  const Scale scale = scale_of(solid.unit, 1);
  const auto all = [&](const std::array<ExactPoint, 3>& at) {
    const auto one = [&](std::size_t i) {
      return told(at[i].at[i] * scale.numerator,
                  at[i].below * scale.denominator);
    };
    return std::array{one(0), one(1), one(2)};
  };
  return std::array{all(found.low), all(found.high)};
}

}  // namespace

std::array<std::array<double, 3>, 2> bounds_of(const fast::Solid& solid) {
  return told_bounds(solid, [](const Integer& n, const Integer& d) {
    return nearest_double(n, d);
  });
}

std::array<std::array<std::string, 3>, 2> exact_bounds_of(
    const fast::Solid& solid) {
  return told_bounds(
      solid, [](const Integer& n, const Integer& d) { return text_of(n, d); });
}

}  // namespace halfspace::csg
