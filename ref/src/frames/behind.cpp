#include "halfspace/ref/behind.hpp"

#include "../vector.hpp"
#include "halfspace/assert.hpp"

namespace halfspace::ref {

bool is_behind(const Plane& plane, const Camera& camera, Side side) {
  HALFSPACE_ASSERT(side != Side::kOn);
  const Side eye = side_of_eye(plane, camera);
  // Rays begin at the eye, or for an eye at infinity go on both ways.
  if (camera->perspective ? eye == side : eye != Side::kOn) return false;
  const Point normal = normal_of(plane);
  const Rational step = 1 << kLatticeBits;
  for (const std::int32_t x : {0, camera->width_px}) {
    for (const std::int32_t y : {0, camera->height_px}) {
      // Along a ray the plane's function grows by n.(s - e); a ray that is
      // parallel to the plane stays at h(s).
      Rational growth = dot(normal, to_point(camera->s0)) +
                        Rational(x) * dot(normal, to_point(camera->sx)) +
                        Rational(y) * dot(normal, to_point(camera->sy));
      growth += camera->perspective ? -dot(normal, to_point(camera->eye))
                                    : step * plane.d;
      if (sign(growth) == static_cast<int>(side)) return false;
    }
  }
  return true;
}

}  // namespace halfspace::ref
