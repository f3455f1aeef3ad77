#include <algorithm>
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

struct FractionPoint {
  Fraction x, y, z;
};

FractionPoint fractions(const Point& p) {
  return {Fraction(p.x, p.w), Fraction(p.y, p.w), Fraction(p.z, p.w)};
}

Fraction determinant(const FractionPoint& u, const FractionPoint& v,
                     const FractionPoint& w) {
  return u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) +
         u.z * (v.x * w.y - v.y * w.x);
}

bool operator<(const FractionPoint& p, const FractionPoint& q) {
  if (p.x != q.x) return p.x < q.x;
  if (p.y != q.y) return p.y < q.y;
  return p.z < q.z;
}

FractionPoint minus(const FractionPoint& p, const FractionPoint& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}

/// A line, by its direction with first non-zero component 1 and by the point
/// on it at which that component's coordinate is 0.
struct Line {
  FractionPoint direction;
  FractionPoint origin;
  friend bool operator<(const Line& l, const Line& m) {
    if (l.direction < m.direction) return true;
    if (m.direction < l.direction) return false;
    return l.origin < m.origin;
  }
};

Line line_through(const FractionPoint& p, const FractionPoint& q) {
  const FractionPoint d = minus(q, p);
  const Fraction& lead = d.x != 0 ? d.x : d.y != 0 ? d.y : d.z;
  const Fraction& at = d.x != 0 ? p.x : d.y != 0 ? p.y : p.z;
  const FractionPoint direction{d.x / lead, d.y / lead, d.z / lead};
  return {
      direction,
      {p.x - at * direction.x, p.y - at * direction.y, p.z - at * direction.z}};
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
    const FractionPoint p = fractions(polygon[k]);
    const FractionPoint q = fractions(polygon[(k + 1) % polygon.size()]);
    area.x += p.y * q.z - p.z * q.y;
    area.y += p.z * q.x - p.x * q.z;
    area.z += p.x * q.y - p.y * q.x;
  }
  return area;
}

Fraction volume6(const std::vector<std::vector<Point>>& polygons) {
  Fraction sum = 0;
  for (const std::vector<Point>& polygon : polygons) {
    const FractionPoint first = fractions(polygon[0]);
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      sum +=
          determinant(first, fractions(polygon[k]), fractions(polygon[k + 1]));
    }
  }
  return sum;
}

bool is_closed(const std::vector<std::vector<Point>>& polygons) {
  // On each line: by how much the number of edges that run forwards exceeds
  // that of those that run backwards changes at each point.
  std::map<Line, std::map<FractionPoint, int>> steps;
  for (const std::vector<Point>& polygon : polygons) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const FractionPoint p = fractions(polygon[k]);
      const FractionPoint q = fractions(polygon[(k + 1) % polygon.size()]);
      auto& on_line = steps[line_through(p, q)];
      // Along a line the points are in lexicographic order, or all in reverse.
      on_line[p] += 1;
      on_line[q] -= 1;
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
