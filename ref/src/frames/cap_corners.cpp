#include "cap_corners.hpp"

#include <algorithm>

#include "../vector.hpp"
#include "halfspace/ref/clip.hpp"

namespace halfspace::ref {
namespace {

/// A coordinate of a point.
const Rational& along(const Point& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// The point in which two planes meet a third, whose normal is `x` and which
/// has `at` as the product of its points with that.
std::optional<Point> meet(const Plane& f, const Plane& g, const Point& x,
                          const Rational& at) {
  const Point m = normal_of(f);
  const Point n = normal_of(g);
  const Point u = cross(m, n);
  const Point v = cross(n, x);
  const Point w = cross(x, m);
  const Rational volume = dot(x, u);
  if (sign(volume) == 0) return std::nullopt;
  const auto part = [&](std::size_t axis) {
    return (at * along(u, axis) - f.d * along(v, axis) - g.d * along(w, axis)) /
           volume;
  };
  return Point{part(0), part(1), part(2)};
}

}  // namespace

std::optional<std::pair<Point, Point>> corner_line(
    const std::vector<Fragment>& polygons, const ClipPlane& first,
    const ClipPlane& second) {
  std::vector<Point> corners;
  for (const Fragment& polygon : polygons)
    corners.insert(corners.end(), polygon.vertices.begin(),
                   polygon.vertices.end());
  std::vector<Rational> lows;
  std::vector<Rational> highs;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(
        corners.begin(), corners.end(), [axis](const Point& p, const Point& q) {
          return along(p, axis) < along(q, axis);
        });
    lows.push_back(along(*low, axis) - Rational(1));
    highs.push_back(along(*high, axis) + Rational(1));
  }
  const auto is_in_box = [&](const Point& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (along(p, axis) < lows[axis] || highs[axis] < along(p, axis))
        return false;
    }
    return true;
  };
  std::vector<Point> points;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Point x = {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
    for (const Rational& at : {lows[axis], highs[axis]}) {
      const auto p = meet(function_of(first), function_of(second), x, at);
      if (p && is_in_box(*p)) points.push_back(*p);
    }
  }
  if (points.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  if (!(*low < *high)) return std::nullopt;
  return std::pair{*low, *high};
}

bool do_caps_meet(const std::vector<Fragment>& polygons,
                  const std::vector<ClipPlane>& clips, std::size_t first,
                  std::size_t second, const Point& p) {
  const Point inwards = normal_of(function_of(clips[first]));
  const Point line = cross(inwards, normal_of(function_of(clips[second])));
  const Point beside = cross(line, inwards);
  // The sign infinitely near `p`: in the first plane, on the positive side of
  // the second, and next to it on what the first keeps.
  const auto near_sign = [&](const Plane& plane) {
    const Point n = normal_of(plane);
    if (const int s = sign(value_at(plane, p))) return s;
    if (const int s = sign(dot(n, beside))) return s;
    return sign(dot(n, inwards));
  };
  for (const ClipPlane& clip : clips) {
    if (near_sign(function_of(clip)) <= 0) return false;
  }
  // A ray from there along the line leaves what it is in.
  int winding = 0;
  for (const Fragment& polygon : polygons) {
    const Plane plane = plane_of(polygon.vertices);
    const Rational slope = dot(normal_of(plane), line);
    if (sign(slope) == 0 || near_sign(plane) * sign(slope) > 0) continue;
    bool is_inside = true;
    for (std::size_t k = 0; k < polygon.vertices.size(); ++k) {
      const Point& from = polygon.vertices[k];
      const Point& to = polygon.vertices[(k + 1) % polygon.vertices.size()];
      const Plane side =
          plane_through(cross(normal_of(plane), difference(to, from)), from);
      const Rational share = dot(normal_of(side), line) / slope;
      // The side's value where the ray meets the polygon's plane.
      const Plane met = {side.a - share * plane.a, side.b - share * plane.b,
                         side.c - share * plane.c, side.d - share * plane.d};
      is_inside = is_inside && near_sign(met) > 0;
    }
    if (is_inside) winding += sign(slope);
  }
  return winding > 0;
}

}  // namespace halfspace::ref
