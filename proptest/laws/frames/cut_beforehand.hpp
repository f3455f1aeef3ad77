#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "definition/definition.hpp"
#include "halfspace/clip.hpp"
#include "halfspace/int128.hpp"

/// What clip planes leave of polygons, by the definition (S10.2).
namespace halfspace::cut_beforehand {

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

}  // namespace halfspace::cut_beforehand
