#include <algorithm>

#include "definition/definition.hpp"

namespace halfspace::definition {
namespace {

Integer integer(std::int64_t value) { return Integer(value); }

struct Vector {
  Integer x, y, z;
};

Vector cross(const Vector& u, const Vector& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

Vector position(const GridPoint& p) {
  return {integer(p.x), integer(p.y), integer(p.z)};
}

/// The point of three planes: the columns of their matrix, crossed.
Point meet(const Plane& p, const Plane& q, const Plane& r) {
  const Vector n{p.a, p.b, p.c};
  const Vector m{q.a, q.b, q.c};
  const Vector k{r.a, r.b, r.c};
  const Vector mk = cross(m, k);
  const Vector kn = cross(k, n);
  const Vector nm = cross(n, m);
  Point point{-(p.d * mk.x + q.d * kn.x + r.d * nm.x),
              -(p.d * mk.y + q.d * kn.y + r.d * nm.y),
              -(p.d * mk.z + q.d * kn.z + r.d * nm.z),
              n.x * mk.x + n.y * mk.y + n.z * mk.z};
  if (point.w < 0) point = {-point.x, -point.y, -point.z, -point.w};
  return point;
}

/// The plane through an edge of a polygon, along the polygon's normal:
/// positive where the polygon is.
Plane source_edge(const Scene& scene, PolygonId polygon, std::size_t edge) {
  const auto corners = scene.corners(polygon);
  const Plane support = plane_of(scene, polygon);
  const Vector p = position(scene.point(corners[edge]));
  const Vector q = position(scene.point(corners[(edge + 1) % corners.size()]));
  const Vector m = cross({support.a, support.b, support.c},
                         {q.x - p.x, q.y - p.y, q.z - p.z});
  return {m.x, m.y, m.z, -(m.x * p.x + m.y * p.y + m.z * p.z)};
}

Plane plane_of_edge(const Scene& scene, PolygonId source, EdgeName edge) {
  if (edge.kind == EdgeName::Kind::kSplitter)
    return plane_of(scene, edge.index);
  return source_edge(scene, source, static_cast<std::size_t>(edge.index));
}

}  // namespace

bool operator==(const Point& p, const Point& q) {
  return p.x * q.w == q.x * p.w && p.y * q.w == q.y * p.w &&
         p.z * q.w == q.z * p.w;
}

Point to_point(const GridPoint& p) {
  return {integer(p.x), integer(p.y), integer(p.z), 1};
}

Plane plane_of(const Scene& scene, PolygonId polygon) {
  const auto corners = scene.corners(polygon);
  const GridPoint& first = scene.point(corners[0]);
  const Vector p0 = position(first);
  const auto from_first = [&](std::size_t i) {
    const Vector p = position(scene.point(corners[i]));
    return Vector{p.x - p0.x, p.y - p0.y, p.z - p0.z};
  };
  Vector n{0, 0, 0};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vector area = cross(from_first(i), from_first(i + 1));
    n = {n.x + area.x, n.y + area.y, n.z + area.z};
  }
  return {n.x, n.y, n.z, -(n.x * p0.x + n.y * p0.y + n.z * p0.z)};
}

int side_of(const Plane& plane, const Point& p) {
  const Integer h =
      plane.a * p.x + plane.b * p.y + plane.c * p.z + plane.d * p.w;
  return h.sign();
}

Relation relation(const std::vector<Point>& points, const Plane& plane) {
  bool positive = false, negative = false;
  for (const Point& p : points) {
    const int side = side_of(plane, p);
    positive = positive || side > 0;
    negative = negative || side < 0;
    if (positive && negative) return Relation::kSpanning;
  }
  if (positive) return Relation::kPositive;
  return negative ? Relation::kNegative : Relation::kCoincident;
}

FragmentName whole(const Scene& scene, PolygonId polygon) {
  FragmentName name{polygon, {}};
  for (std::size_t i = 0; i < scene.corners(polygon).size(); ++i) {
    name.edges.push_back(
        {EdgeName::Kind::kSource, static_cast<std::int32_t>(i)});
  }
  return name;
}

std::vector<Point> points_of(const Scene& scene, const FragmentName& fragment) {
  const auto corners = scene.corners(fragment.source);
  const Plane support = plane_of(scene, fragment.source);
  std::vector<Point> points;
  const std::size_t count = fragment.edges.size();
  for (std::size_t k = 0; k < count; ++k) {
    const EdgeName before = fragment.edges[(k + count - 1) % count];
    const EdgeName after = fragment.edges[k];
    if (before.kind == EdgeName::Kind::kSource &&
        after.kind == EdgeName::Kind::kSource) {
      // Two edges of the source in turn: its own corner, straight or not.
      points.push_back(to_point(
          scene.point(corners[static_cast<std::size_t>(after.index)])));
    } else {
      points.push_back(meet(support,
                            plane_of_edge(scene, fragment.source, before),
                            plane_of_edge(scene, fragment.source, after)));
    }
  }
  return points;
}

Facet facet_of(const Scene& scene, const FragmentName& fragment) {
  Facet facet{plane_of(scene, fragment.source), {}};
  const std::vector<Point> points = points_of(scene, fragment);
  for (const EdgeName edge : fragment.edges) {
    Plane plane = plane_of_edge(scene, fragment.source, edge);
    if (relation(points, plane) == Relation::kNegative)
      plane = {-plane.a, -plane.b, -plane.c, -plane.d};
    facet.edges.push_back(plane);
  }
  return facet;
}

Facet facet_of(const std::vector<Point>& vertices) {
  // Homogeneous differences: vectors, up to a positive factor.
  const auto difference = [](const Point& p, const Point& q) {
    return Vector{q.x * p.w - p.x * q.w, q.y * p.w - p.y * q.w,
                  q.z * p.w - p.z * q.w};
  };
  const auto through = [](const Vector& n, const Point& p) {
    return Plane{n.x * p.w, n.y * p.w, n.z * p.w,
                 -(n.x * p.x + n.y * p.y + n.z * p.z)};
  };
  const std::size_t count = vertices.size();
  Facet facet;
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const Vector n = cross(difference(vertices[0], vertices[k]),
                           difference(vertices[0], vertices[k + 1]));
    if (n.x == 0 && n.y == 0 && n.z == 0) continue;
    facet.support = through(n, vertices[0]);
    break;
  }
  const Vector normal{facet.support.a, facet.support.b, facet.support.c};
  for (std::size_t k = 0; k < count; ++k) {
    const Vector along = difference(vertices[k], vertices[(k + 1) % count]);
    facet.edges.push_back(through(cross(normal, along), vertices[k]));
  }
  return facet;
}

Parts split(const Scene& scene, const FragmentName& fragment,
            PolygonId splitter) {
  const Plane plane = plane_of(scene, splitter);
  const std::vector<Point> points = points_of(scene, fragment);
  const std::size_t count = points.size();
  // Each part has the edges with an end strictly on its side, in order. The
  // splitter comes after the edge that leaves that side.
  const auto part = [&](int side) {
    FragmentName name{fragment.source, {}};
    for (std::size_t k = 0; k < count; ++k) {
      const int from = side * side_of(plane, points[k]);
      const int to = side * side_of(plane, points[(k + 1) % count]);
      if (from > 0 || to > 0) name.edges.push_back(fragment.edges[k]);
      if (from > 0 && to <= 0)
        name.edges.push_back({EdgeName::Kind::kSplitter, splitter});
    }
    name.edges = rotated_to_least(name.edges);
    return name;
  };
  return {part(1), part(-1)};
}

}  // namespace halfspace::definition
