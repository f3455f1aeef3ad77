#include "halfspace/ref/shade.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include "halfspace/cap_parts.hpp"
#include "halfspace/ref/predicate.hpp"
#include "vector.hpp"

namespace halfspace::ref {
namespace {

/// p + scale * v.
Point along(const Point& p, const Rational& scale, const Point& v) {
  return {p.x + scale * v.x, p.y + scale * v.y, p.z + scale * v.z};
}

/// The point that an image point sees in the plane through `corners`.
/// Units: lattice steps, the corners too.
Point point_seen(const Camera& camera, const std::array<Point, 3>& corners,
                 const ImagePoint& at) {
  const Point eye = to_point(camera->eye);
  const Point s = along(along(to_point(camera->s0), at.x, to_point(camera->sx)),
                        at.y, to_point(camera->sy));
  // The ray is start + t * direction.
  const Point start = camera->perspective ? eye : s;
  const Point direction =
      camera->perspective ? difference(s, eye) : difference({0, 0, 0}, eye);
  const Plane plane = plane_of({corners[0], corners[1], corners[2]});
  const Rational speed = dot(normal_of(plane), direction);
  return along(start, Rational(0) - value_at(plane, start) / speed, direction);
}

/// Twice the area of the triangle p, q, r, negative if that turns against the
/// normal `n` of its plane; times the length of n.
Rational area(const Plane& n, const Point& p, const Point& q, const Point& r) {
  const Plane turn = {(q.y - p.y) * (r.z - p.z) - (q.z - p.z) * (r.y - p.y),
                      (q.z - p.z) * (r.x - p.x) - (q.x - p.x) * (r.z - p.z),
                      (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x), 0};
  return turn.a * n.a + turn.b * n.b + turn.c * n.c;
}

}  // namespace

ExactColor exact(const Rgb& color) { return {color.r, color.g, color.b}; }

Rgb rounded_color(const ExactColor& color) {
  const auto channel = [](const Rational& value) {
    const Rational half = Rational(1) / Rational(2);
    return static_cast<std::uint8_t>(floor(value + half).to_int64());
  };
  return {channel(color[0]), channel(color[1]), channel(color[2])};
}

std::array<Rational, 3> corner_shares(const Scene& scene, const Camera& camera,
                                      PolygonId triangle,
                                      const ImagePoint& point) {
  std::array<Point, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point corner = to_point(scene.point(scene.corners(triangle)[k]));
    p[k] = along({0, 0, 0}, Rational(1 << kLatticeBits), corner);
  }
  const Point seen = point_seen(camera, p, point);
  const Plane plane = plane_of({p[0], p[1], p[2]});
  std::array<Rational, 3> share = {area(plane, seen, p[1], p[2]),
                                   area(plane, seen, p[2], p[0]),
                                   area(plane, seen, p[0], p[1])};
  const Rational total = share[0] + share[1] + share[2];
  for (Rational& part : share) part = part / total;
  return share;
}

ExactColor exact_color_at(const Scene& scene, const Camera& camera,
                          PolygonId polygon, const ImagePoint& point,
                          Shading shading) {
  const auto colors = scene.corner_colors(polygon);
  if (shading == Shading::kFlat || colors.empty())
    return exact(scene.color(polygon));
  if (std::adjacent_find(colors.begin(), colors.end(), std::not_equal_to<>()) ==
      colors.end()) {
    return exact(colors.front());
  }

  // Colours differ: a triangle (S1.3).
  const std::array<Rational, 3> share =
      corner_shares(scene, camera, polygon, point);
  ExactColor sum = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactColor corner = exact(colors[k]);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += share[k] * corner[c];
  }
  return sum;
}

Rgb color_at(const Scene& scene, const Camera& camera, PolygonId polygon,
             std::int32_t i, std::int32_t j, Shading shading) {
  // The centre's ray meets the polygon: the sample, next to it, sees a point of
  // the bounded polygon.
  const Rational half = Rational(1) / Rational(2);
  const ImagePoint centre = {Rational(i) + half, Rational(j) + half};
  return rounded_color(exact_color_at(scene, camera, polygon, centre, shading));
}

ColorImage colors_of(const Scene& scene, const Camera& camera,
                     const ItemImage& items, const ImageOptions& options) {
  ColorImage colors(items.width_px, items.height_px, options.background);
  const auto polygons = static_cast<PolygonId>(scene.polygon_count());
  for (std::int32_t j = 0; j < items.height_px; ++j) {
    for (std::int32_t i = 0; i < items.width_px; ++i) {
      const PolygonId seen = items.at(i, j);
      if (seen == kBackground) continue;
      if (seen >= polygons) {
        colors.at(i, j) = cap_color_at_sample(
            options, cap_item(static_cast<std::size_t>(seen - polygons)), i, j,
            1);
        continue;
      }
      colors.at(i, j) = color_at(scene, camera, seen, i, j, options.shading);
    }
  }
  return colors;
}

Rgb marked(const Rgb& mark, const Rgb& color) {
  const int light = std::max({color.r, color.g, color.b});
  ExactColor dimmed = exact(mark);
  for (Rational& channel : dimmed)
    channel = channel * Rational(255 + light) / Rational(510);
  return rounded_color(dimmed);
}

void mark_back_faces(const Scene& scene, const Camera& camera,
                     const ItemImage& items, const Rgb& mark,
                     ColorImage& colors) {
  const std::vector<Plane> planes = planes_of(scene);
  for (std::size_t k = 0; k < items.pixels.size(); ++k) {
    const PolygonId seen = items.pixels[k];
    if (seen == kBackground) continue;
    const auto p = static_cast<std::size_t>(seen);
    if (p >= planes.size()) continue;  // a cap
    if (side_of_eye(planes[p], camera) != Side::kNegative) continue;
    colors.pixels[k] = marked(mark, colors.pixels[k]);
  }
}

}  // namespace halfspace::ref
