#include "halfspace/csg/surface.hpp"

#include <algorithm>

namespace halfspace::csg {
namespace {

/// Requires: not the least of all, which no normal has.
Integer widened(Int128 value) {
  const bool negative = value < 0;
  const Int128 size = negative ? -value : value;
  Integer result = static_cast<std::uint64_t>(size >> 64);
  result <<= 64;
  result += static_cast<std::uint64_t>(size);
  return negative ? Integer(-result) : result;
}

Integers3 integers(const GridPoint& p) { return {p.x, p.y, p.z}; }

Integers3 integers(const std::array<Int128, 3>& v) {
  return {widened(v[0]), widened(v[1]), widened(v[2])};
}

/// Where three planes meet, by Cramer's rule.
ExactPoint meet(const fast::Solid& solid,
                const std::array<std::int32_t, 3>& planes) {
  std::array<Integers3, 3> n;
  Integers3 offset;
  for (std::size_t i = 0; i < 3; ++i) {
    const fast::SolidPlane plane = fast::plane_at(solid, planes[i]);
    n[i] = integers(plane.normal);
    offset[i] = dot(n[i], integers(plane.origin));
  }
  ExactPoint point;
  for (std::size_t i = 0; i < 3; ++i) {
    const Integers3 product = cross(n[(i + 1) % 3], n[(i + 2) % 3]);
    for (std::size_t k = 0; k < 3; ++k) point.at[k] += offset[i] * product[k];
  }
  point.below = dot(n[0], cross(n[1], n[2]));
  if (point.below < 0) {
    point.below = -point.below;
    for (Integer& c : point.at) c = -c;
  }
  Integer divisor = point.below;
  for (const Integer& c : point.at) divisor = gcd(divisor, c);
  point.below /= divisor;
  for (Integer& c : point.at) c /= divisor;
  return point;
}

}  // namespace

Integers3 cross(const Integers3& a, const Integers3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

Integer dot(const Integers3& a, const Integers3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

const ExactPoint& ExactSurface::point(std::int32_t vertex) {
  const auto [at, is_new] = points_.try_emplace(vertex);
  if (!is_new) return at->second;
  const fast::SolidVertex v = fast::vertex_at(solid_, vertex);
  at->second =
      v.is_grid ? ExactPoint{integers(v.point), 1} : meet(solid_, v.planes);
  return at->second;
}

Integers3 ExactSurface::normal(const fast::Face& face) const {
  Integers3 normal = integers(fast::plane_at(solid_, face.plane).normal);
  if (face.flipped) {
    for (Integer& c : normal) c = -c;
  }
  return normal;
}

Integers3 ExactSurface::origin(const fast::Face& face) const {
  return integers(fast::plane_at(solid_, face.plane).origin);
}

int side_of(const ExactSurface& surface, const fast::Face& face,
            const ExactPoint& point) {
  const Integers3 normal = surface.normal(face);
  return Integer(dot(normal, point.at) -
                 dot(normal, surface.origin(face)) * point.below)
      .sign();
}

ExactPoint in_steps(const Numbers3& at, const Unit& unit) {
  std::int32_t two = 0, five = 0;
  std::array<io::Number, 3> scaled = at;
  for (io::Number& c : scaled) {
    if (c.mantissa == 0) continue;
    c.two -= unit.exponent;
    c.five -= unit.base == 10 ? unit.exponent : 0;
    two = std::min(two, c.two);
    five = std::min(five, c.five);
  }
  const auto power = [](int base, std::int32_t exponent) -> Integer {
    return pow(Integer(base), static_cast<unsigned>(exponent));
  };
  ExactPoint point;
  for (std::size_t i = 0; i < 3; ++i) {
    const io::Number& c = scaled[i];
    if (c.mantissa == 0) continue;
    point.at[i] = c.mantissa * power(2, c.two - two) * power(5, c.five - five);
  }
  point.below = power(2, -two) * power(5, -five);
  return point;
}

Integer area2(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c,
              std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto minor = [u, v](const ExactPoint& p, const ExactPoint& q) {
    return Integer(p.at[u] * q.at[v] - p.at[v] * q.at[u]);
  };
  return minor(a, b) * c.below + minor(b, c) * a.below + minor(c, a) * b.below;
}

bool same(const ExactPoint& a, const ExactPoint& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.at[i] * b.below != b.at[i] * a.below) return false;
  }
  return true;
}

std::size_t longest_axis(const Integers3& normal) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (abs(normal[i]) > abs(normal[axis])) axis = i;
  }
  return axis;
}

int compare(const ExactPoint& a, const ExactPoint& b, std::size_t axis) {
  return Integer(a.at[axis] * b.below - b.at[axis] * a.below).sign();
}

int turns_round(ExactSurface& surface, const fast::Face& face,
                const ExactPoint& point, std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  int turns = 0;
  for_edges(surface.solid(), face, [&](const fast::SolidEdge& edge) {
    const ExactPoint a = surface.point(edge.from);
    const ExactPoint& b = surface.point(edge.to);
    const bool a_before = compare(a, point, u) <= 0;
    const bool b_before = compare(b, point, u) <= 0;
    if (a_before == b_before) return;
    // The edge passes the point along u. Which side is the point on?
    int left = area2(a, b, point, axis).sign();
    if (left == 0) left = -compare(b, a, v);
    if (left == 0) left = compare(b, a, u);
    // Those above it count: leftwards ones once, rightwards ones less.
    if (a_before && left < 0) --turns;
    if (b_before && left > 0) ++turns;
  });
  return turns;
}

bool is_in_face(ExactSurface& surface, const fast::Face& face,
                const ExactPoint& point) {
  const std::size_t axis = longest_axis(surface.normal(face));
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  bool on_edge = false;
  for_edges(surface.solid(), face, [&](const fast::SolidEdge& edge) {
    const ExactPoint a = surface.point(edge.from);
    const ExactPoint& b = surface.point(edge.to);
    if (on_edge || area2(a, b, point, axis) != 0) return;
    on_edge = compare(a, point, u) * compare(b, point, u) <= 0 &&
              compare(a, point, v) * compare(b, point, v) <= 0;
  });
  return on_edge || turns_round(surface, face, point, axis) != 0;
}

}  // namespace halfspace::csg
