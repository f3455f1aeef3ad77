#include "halfspace/ref/clip.hpp"

#include "halfspace/ref/split.hpp"
#include "vector.hpp"

namespace halfspace::ref {

Plane function_of(const ClipPlane& clip) {
  return {clip.a, clip.b, clip.c, clip.d};
}

bool is_there(const Plane& plane, const ImageOptions& options) {
  if (!options.caps) return true;
  for (const ClipPlane& clip : options.clips) {
    const Plane c = function_of(clip);
    const Point turn = cross(normal_of(plane), normal_of(c));
    const bool is_parallel = turn == Point{0, 0, 0};
    // Parallel planes are the same if their offsets are in proportion.
    const Rational along = dot(normal_of(plane), normal_of(c));
    const Rational square = dot(normal_of(c), normal_of(c));
    if (is_parallel && plane.d * square == c.d * along) return false;
  }
  return true;
}

std::optional<Fragment> clipped(Fragment fragment,
                                const ImageOptions& options) {
  constexpr PolygonId kNoSplitter = -1;
  for (const ClipPlane& clip : options.clips) {
    const Plane plane = function_of(clip);
    switch (relation(fragment, plane)) {
      case Relation::kPositive:
      case Relation::kCoincident:
        break;
      case Relation::kNegative:
        return std::nullopt;
      case Relation::kSpanning:
        fragment = split(fragment, plane, kNoSplitter).positive;
        break;
    }
  }
  return fragment;
}

}  // namespace halfspace::ref
