#include "halfspace/ref/projection.hpp"

#include "halfspace/assert.hpp"
#include "halfspace/ref/split.hpp"
#include "vector.hpp"

namespace halfspace::ref {
namespace {

/// scale * f + other * g, as functions of a point.
Plane combination(const Rational& scale, const Plane& f, const Rational& other,
                  const Plane& g) {
  return {scale * f.a + other * g.a, scale * f.b + other * g.b,
          scale * f.c + other * g.c, scale * f.d + other * g.d};
}

Plane constant(const Rational& value) { return {0, 0, 0, value}; }

}  // namespace

Projection projection_of(const Camera& camera) {
  const Point sx = to_point(camera->sx);
  const Point sy = to_point(camera->sy);
  const Point s0 = to_point(camera->s0);
  const Point eye = to_point(camera->eye);
  const Point origin = camera->perspective ? eye : s0;
  const Point depth =
      camera->perspective ? difference(s0, eye) : difference({0, 0, 0}, eye);

  // p - origin = X sx + Y sy + t depth, solved by Cramer's rule. All three
  // numerators keep the determinant's size as their common denominator, which
  // is positive once its sign has gone into the numerators.
  const Rational determinant = dot(cross(sx, sy), depth);
  const int orientation = sign(determinant);
  HALFSPACE_ASSERT(orientation != 0);
  const auto coordinate = [&](const Point& row) -> Plane {
    // Points come in grid steps, 2^8 lattice steps each.
    const Rational scale = orientation * (1 << kLatticeBits);
    return {scale * row.x, scale * row.y, scale * row.z,
            Rational(-orientation) * dot(row, origin)};
  };
  const Rational one = Rational(orientation) * determinant;
  const Plane t = coordinate(cross(sx, sy));

  Projection projection;
  projection.x = coordinate(cross(sy, depth));
  projection.y = coordinate(cross(depth, sx));
  projection.w = camera->perspective ? t : constant(one);

  // t > near / 2^16.
  if (camera->perspective || camera->near) {
    const Rational near = camera->near.value_or(0);
    projection.view_volume.push_back(combination(
        Rational(1 << kNearBits), t, Rational(0) - near, constant(one)));
  }
  // 0 < x/w < width and 0 < y/w < height.
  const auto add_strip = [&](const Plane& f, std::int32_t size) {
    projection.view_volume.push_back(f);
    projection.view_volume.push_back(
        combination(Rational(size), projection.w, Rational(-1), f));
  };
  add_strip(projection.x, camera->width_px);
  add_strip(projection.y, camera->height_px);
  return projection;
}

Fragment clip(Fragment fragment, const Projection& projection) {
  for (const Plane& plane : projection.view_volume) {
    switch (relation(fragment, plane)) {
      case Relation::kPositive:
        break;
      case Relation::kSpanning:
        fragment = split(fragment, plane, fragment.source).positive;
        break;
      case Relation::kCoincident:  // edge-on, or at the near distance: unseen
      case Relation::kNegative:
        return {fragment.source, {}, {}};
    }
  }
  return fragment;
}

ImagePoint image_of(const Point& p, const Projection& projection) {
  const Rational w = value_at(projection.w, p);
  return {value_at(projection.x, p) / w, value_at(projection.y, p) / w};
}

}  // namespace halfspace::ref
