#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "definition/definition.hpp"

namespace halfspace::definition {
namespace {

Integer value_at(const Plane& plane, const Point& p) {
  return plane.a * p.x + plane.b * p.y + plane.c * p.z + plane.d * p.w;
}

/// The sign of a function c + x e + y e^2 for an infinitely small e > 0.
int sign_near_zero(const Affine& f) {
  if (f.c != 0) return f.c.sign();
  return f.x != 0 ? f.x.sign() : f.y.sign();
}

/// A plane's value at points beside `p`, moved along the y and z axes.
Affine beside(const Plane& plane, const Point& p) {
  return {value_at(plane, p), plane.b * p.w, plane.c * p.w};
}

/// Numbers that mean the same times any common factor, without one, so that
/// equal things are equal. The first that is not 0 is positive.
template <std::size_t kCount>
std::array<Integer, kCount> reduced(std::array<Integer, kCount> numbers) {
  Integer common = 0;
  for (const Integer& number : numbers) common = gcd(common, number);
  const auto lead = std::find_if(numbers.begin(), numbers.end(),
                                 [](const Integer& n) { return n != 0; });
  if (lead != numbers.end() && *lead < 0) common = -common;
  for (Integer& number : numbers) number /= common;
  return numbers;
}

using PointKey = std::array<Integer, 4>;
PointKey key_of(const Point& p) { return reduced<4>({p.w, p.x, p.y, p.z}); }

/// A line by its direction and its moment about the origin (Pluecker's
/// coordinates).
using LineKey = std::array<Integer, 6>;
LineKey line_through(const Point& p, const Point& q) {
  return reduced<6>({q.x * p.w - p.x * q.w, q.y * p.w - p.y * q.w,
                     q.z * p.w - p.z * q.w, p.y * q.z - p.z * q.y,
                     p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x});
}

}  // namespace

int winding(const std::vector<Facet>& facets, const Point& p) {
  // The ray goes from p along the x axis, moved aside by (e, e^2) in y and z
  // so that it meets no edge. Leaving a closed surface counts 1.
  int count = 0;
  for (const Facet& facet : facets) {
    const int sigma = facet.support.a.sign();
    if (sigma == 0) continue;
    const Affine h = beside(facet.support, p);
    // h falls along the ray from here to the facet, or rises to it.
    if (sigma * sign_near_zero(h) >= 0) continue;
    const bool met = std::all_of(
        facet.edges.begin(), facet.edges.end(), [&](const Plane& edge) {
          const Affine q = beside(edge, p);
          const Affine at_facet{facet.support.a * q.c - edge.a * h.c,
                                facet.support.a * q.x - edge.a * h.x,
                                facet.support.a * q.y - edge.a * h.y};
          return sigma * sign_near_zero(at_facet) > 0;
        });
    if (met) count += sigma;
  }
  return count;
}

Area operator+(const Area& a, const Area& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

Area area_of(const std::vector<Point>& polygon) {
  Area area;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point& p = polygon[k];
    const Point& q = polygon[(k + 1) % polygon.size()];
    const Integer w = p.w * q.w;
    area.x += Fraction(p.y * q.z - p.z * q.y, w);
    area.y += Fraction(p.z * q.x - p.x * q.z, w);
    area.z += Fraction(p.x * q.y - p.y * q.x, w);
  }
  return area;
}

Fraction volume6(const std::vector<std::vector<Point>>& polygons) {
  Fraction sum = 0;
  for (const std::vector<Point>& polygon : polygons) {
    const Point& u = polygon[0];
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      const Point& v = polygon[k];
      const Point& w = polygon[k + 1];
      const Integer determinant = u.x * (v.y * w.z - v.z * w.y) -
                                  u.y * (v.x * w.z - v.z * w.x) +
                                  u.z * (v.x * w.y - v.y * w.x);
      sum += Fraction(determinant, u.w * v.w * w.w);
    }
  }
  return sum;
}

bool is_closed(const std::vector<std::vector<Point>>& polygons) {
  // On each line: by how much the number of edges that run one way exceeds that
  // of those that run the other way changes at each point.
  std::map<LineKey, std::map<PointKey, int>> steps;
  for (const std::vector<Point>& polygon : polygons) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point& p = polygon[k];
      const Point& q = polygon[(k + 1) % polygon.size()];
      auto& on_line = steps[line_through(p, q)];
      on_line[key_of(p)] += 1;
      on_line[key_of(q)] -= 1;
    }
  }
  for (const auto& [line, on_line] : steps) {
    for (const auto& [point, step] : on_line) {
      if (step != 0) return false;
    }
  }
  return true;
}

}  // namespace halfspace::definition
