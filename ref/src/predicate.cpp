#include "halfspace/ref/predicate.hpp"

#include <tuple>

#include "halfspace/assert.hpp"
#include "vector.hpp"

namespace halfspace::ref {
namespace {

Side side_of_sign(int sign) { return static_cast<Side>(sign); }

}  // namespace

bool operator<(const Point& p, const Point& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

Point to_point(const GridPoint& p) { return {p.x, p.y, p.z}; }

Fragment whole(const Scene& scene, PolygonId id) {
  Fragment fragment{id, {}, {}};
  for (const VertexId vertex : scene.corners(id)) {
    const auto corner = static_cast<std::int32_t>(fragment.edges.size());
    fragment.edges.push_back({EdgeName::Kind::kSource, corner});
    fragment.vertices.push_back(to_point(scene.point(vertex)));
  }
  return fragment;
}

Plane plane_of(const std::vector<Point>& vertices) {
  const std::size_t count = vertices.size();
  // Never false: some corner turns, since a polygon has an area.
  for (std::size_t i = 0; i < count; ++i) {
    const Point& p0 = vertices[i];
    const Point& p1 = vertices[(i + 1) % count];
    const Point& p2 = vertices[(i + 2) % count];
    const Point n = cross(difference(p1, p0), difference(p2, p0));
    if (n == Point{0, 0, 0}) continue;  // a straight corner
    return plane_through(n, p0);
  }
  HALFSPACE_ASSERT(false && "a polygon has an area");
  return {};
}

std::vector<Plane> planes_of(const Scene& scene) {
  std::vector<Plane> planes;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    planes.push_back(
        plane_of(whole(scene, static_cast<PolygonId>(p)).vertices));
  }
  return planes;
}

Rational value_at(const Plane& plane, const Point& p) {
  return plane.a * p.x + plane.b * p.y + plane.c * p.z + plane.d;
}

Side side_of(const Plane& plane, const Point& p) {
  return side_of_sign(
      sign_of_affine(plane.a, p.x, plane.b, p.y, plane.c, p.z, plane.d));
}

Side side_of_eye(const Plane& plane, const Camera& camera) {
  const LatticeVector& eye = camera->eye;
  Rational value = plane.a * Rational(eye.x) + plane.b * Rational(eye.y) +
                   plane.c * Rational(eye.z);
  // The eye is (x, y, z) / 2^8 in grid steps: h(eye) times 2^8.
  if (camera->perspective) value += plane.d * Rational(1 << kLatticeBits);
  return side_of_sign(sign(value));
}

Relation relation(const Fragment& fragment, const Plane& plane) {
  bool some_positive = false;
  bool some_negative = false;
  for (const Point& vertex : fragment.vertices) {
    const Side side = side_of(plane, vertex);
    some_positive = some_positive || side == Side::kPositive;
    some_negative = some_negative || side == Side::kNegative;
  }
  return relation_of(some_positive, some_negative);
}

FragmentName name_of(const Fragment& fragment) {
  return {fragment.source, rotated_to_least(fragment.edges)};
}

}  // namespace halfspace::ref
