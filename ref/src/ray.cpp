#include "halfspace/ref/ray.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "halfspace/assert.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "vector.hpp"

namespace halfspace::ref {
namespace {

/// A ray in grid steps.
struct Line {
  Point origin, direction;
  Reach reach;

  explicit Line(const Ray& ray) : reach(ray->reach) {
    const auto scaled = [](const LatticeVector& v) {
      const Rational step = Rational(1) / Rational(1 << kLatticeBits);
      return Point{step * v.x, step * v.y, step * v.z};
    };
    origin = scaled(ray->origin);
    direction = scaled(ray->direction);
  }

  Point at(const Rational& t) const {
    return {origin.x + t * direction.x, origin.y + t * direction.y,
            origin.z + t * direction.z};
  }
  bool reaches(const Rational& t) const {
    const Rational zero = 0;
    const Rational one = 1;
    switch (reach) {
      case Reach::kRay:
        return t >= zero;
      case Reach::kSegment:
        return t >= zero && t <= one;
      case Reach::kBetween:
        return t > zero && t < one;
      case Reach::kLine:
        return true;
    }
    return false;
  }
};

/// Whether a point of the polygon's plane is in it, its boundary included.
bool holds(const std::vector<Point>& corners, const Point& normal,
           const Point& p) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point& corner = corners[k];
    const Point edge = difference(corners[(k + 1) % corners.size()], corner);
    const Point inwards = cross(normal, edge);
    if (sign(dot(inwards, difference(p, corner))) < 0) return false;
  }
  return true;
}

/// Where the line hits the polygon (S8.2).
std::optional<Rational> parameter_of(const Line& line,
                                     const std::vector<Point>& corners) {
  const Plane plane = plane_of(corners);
  const Point normal = normal_of(plane);
  // Step 1: the plane.
  const Rational along = dot(normal, line.direction);
  if (sign(along) == 0) return std::nullopt;
  const Rational t = -value_at(plane, line.origin) / along;
  // Step 2: the reach.
  if (!line.reaches(t)) return std::nullopt;
  // Step 3: the polygon.
  if (!holds(corners, normal, line.at(t))) return std::nullopt;
  return t;
}

}  // namespace

std::vector<Hit> all_hits(const Scene& scene, const Ray& ray) {
  const Line line(ray);
  std::vector<Hit> hits;
  for (PolygonId id = 0; id < static_cast<PolygonId>(scene.polygon_count());
       ++id) {
    const auto t = parameter_of(line, whole(scene, id).vertices);
    if (t) hits.push_back({id, *t});
  }
  // Polygons come by id, and stay so where parameters are equal.
  std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return a.parameter < b.parameter;
  });
  return hits;
}

double distance_of(const Hit& hit, const Ray& ray) {
  const Point direction = Line(ray).direction;
  const BigRational square =
      (hit.parameter * hit.parameter * dot(direction, direction)).big();
  if (square.sign() == 0) return 0;
  // The root of an integer, of 64 bits or more, and whether that is all of it:
  // a half of a last place more otherwise, so that rounding sees it.
  BigInteger over = numerator(square);
  const BigInteger under = denominator(square);
  int shift = 0;
  while (over < (under << 128)) {
    over <<= 2;
    ++shift;
  }
  const BigInteger whole = over / under;
  BigInteger root = sqrt(whole);
  const bool is_all = root * root * under == over;
  root <<= 1;
  if (!is_all) root += 1;
  return nearest_double(BigRational(root, BigInteger(1) << (shift + 1)));
}

PolygonId pick(const Scene& scene, const Camera& camera,
               const ImageOptions& options, std::int32_t i, std::int32_t j) {
  if (options.caps) return raycast(scene, camera, options).items.at(i, j);
  std::vector<PolygonId> ids(scene.polygon_count());
  std::iota(ids.begin(), ids.end(), 0);
  return raycast_at(scene, camera, options, i, j, ids);
}

bool see_each_other(const Scene& scene, const Ray& between) {
  HALFSPACE_ASSERT(between->reach == Reach::kBetween);
  return all_hits(scene, between).empty();
}

}  // namespace halfspace::ref
