#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "definition/definition.hpp"
#include "halfspace/clip.hpp"
#include "halfspace/int128.hpp"

/// What clip planes leave of polygons, by the definition (S10.2).
namespace halfspace::cut_beforehand {

using definition::Fraction;
using definition::Integer;

inline definition::Plane to_plane(const ClipPlane& clip) {
  const auto big = [](Int128 value) {
    Integer result = static_cast<std::int64_t>(value >> 64);
    result <<= 64;
    return Integer(result + static_cast<std::uint64_t>(value));
  };
  return {big(clip.a), big(clip.b), big(clip.c), big(clip.d)};
}

inline Integer value_at(const definition::Plane& h,
                        const definition::Point& p) {
  return h.a * p.x + h.b * p.y + h.c * p.z + h.d * p.w;
}

/// The polygon's corners, less what is on the plane's negative side.
inline std::vector<definition::Point> cut(
    const std::vector<definition::Point>& points,
    const definition::Plane& plane) {
  std::vector<definition::Point> left;
  bool some_positive = false;
  bool some_negative = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const definition::Point& p = points[k];
    const definition::Point& q = points[(k + 1) % points.size()];
    const Integer hp = value_at(plane, p);
    const Integer hq = value_at(plane, q);
    some_positive = some_positive || hp > 0;
    some_negative = some_negative || hp < 0;
    if (hp >= 0) left.push_back(p);
    if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) {
      const Integer sign = hp < 0 ? -1 : 1;
      const auto at = [&](const Integer& x, const Integer& y) -> Integer {
        return sign * (hp * y - hq * x);
      };
      left.push_back({at(p.x, q.x), at(p.y, q.y), at(p.z, q.z), at(p.w, q.w)});
    }
  }
  if (some_negative && !some_positive) left.clear();
  return left;
}

/// The winding number next to a point of the plane, on its positive side;
/// nothing where another polygon's plane holds the point.
inline std::optional<int> winding_beside(
    const std::vector<definition::Facet>& facets, const definition::Point& p,
    const definition::Plane& plane) {
  Fraction step = 1;
  for (const definition::Facet& facet : facets) {
    const definition::Plane& h = facet.support;
    const Fraction value = Fraction(value_at(h, p)) / Fraction(p.w);
    const Fraction slope =
        Fraction(Integer(h.a * plane.a + h.b * plane.b + h.c * plane.c));
    if (value == 0) {
      const bool same = h.a * plane.b == h.b * plane.a &&
                        h.b * plane.c == h.c * plane.b &&
                        h.a * plane.c == h.c * plane.a;
      if (!same) return std::nullopt;
      continue;
    }
    if (slope == 0) continue;
    const Fraction t = -value / slope;
    if (t > 0 && t / 2 < step) step = t / 2;
  }
  const Fraction q[3] = {
      Fraction(p.x) / Fraction(p.w) + step * Fraction(plane.a),
      Fraction(p.y) / Fraction(p.w) + step * Fraction(plane.b),
      Fraction(p.z) / Fraction(p.w) + step * Fraction(plane.c)};
  Integer w = 1;
  for (const Fraction& x : q) w = lcm(w, denominator(x));
  const auto whole = [&](const Fraction& x) -> Integer {
    return numerator(x) * (w / denominator(x));
  };
  return definition::winding(facets,
                             {whole(q[0]), whole(q[1]), whole(q[2]), w});
}

}  // namespace halfspace::cut_beforehand
