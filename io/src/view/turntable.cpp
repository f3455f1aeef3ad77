#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "halfspace/io/view.hpp"

namespace halfspace::io {
namespace {

using glm::dvec3;

/// v turned about an axis of length 1.
dvec3 turned(const dvec3& v, const dvec3& axis, double angle) {
  const double c = std::cos(angle);
  return c * v + std::sin(angle) * glm::cross(axis, v) +
         (1 - c) * glm::dot(axis, v) * axis;
}

dvec3 to_double(const LatticeVector& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y),
          static_cast<double>(v.z)};
}

LatticeVector rounded_vector(const dvec3& v) {
  return {static_cast<Int128>(std::round(v.x)),
          static_cast<Int128>(std::round(v.y)),
          static_cast<Int128>(std::round(v.z))};
}

/// The middle of the box round the scene's points. Units: lattice steps.
dvec3 lattice_middle(const Scene& scene) {
  const auto& points = scene.data().vertices;
  if (points.empty()) return dvec3(0);
  const auto vector = [](const GridPoint& p) { return dvec3(p.x, p.y, p.z); };
  dvec3 low = vector(points.front());
  dvec3 high = low;
  for (const GridPoint& p : points) {
    low = glm::min(low, vector(p));
    high = glm::max(high, vector(p));
  }
  return double{1 << kLatticeBits} * (low / 2.0 + high / 2.0);
}

}  // namespace

ViewOptions turned_about(const ViewOptions& view, const dvec3& axis,
                         double angle) {
  // The sum of target and difference would round the eye.
  if (angle == 0) return view;
  ViewOptions result = view;
  result.eye = view.target + turned(view.eye - view.target, axis, angle);
  result.up = turned(view.up, axis, angle);
  return result;
}

Result<Camera> turned_about(const Scene& scene, const Camera& camera,
                            const dvec3& axis, double angle) {
  if (angle == 0) return camera;
  CameraData data = camera.data();
  const dvec3 eye = to_double(data.eye);
  const dvec3 corner = to_double(data.s0);
  const dvec3 right = to_double(data.sx);
  const dvec3 down = to_double(data.sy);
  const dvec3 center =
      corner + data.width_px / 2.0 * right + data.height_px / 2.0 * down;
  const dvec3 along = data.perspective ? center - eye : -eye;
  const double share =
      glm::dot(lattice_middle(scene) - center, along) / glm::dot(along, along);
  const dvec3 pivot = center + share * along;
  const auto moved = [&](const dvec3& point) {
    return rounded_vector(pivot + turned(point - pivot, axis, angle));
  };
  data.eye =
      data.perspective ? moved(eye) : rounded_vector(turned(eye, axis, angle));
  data.s0 = moved(corner);
  data.sx = rounded_vector(turned(right, axis, angle));
  data.sy = rounded_vector(turned(down, axis, angle));
  return make_camera(data, scene.grid_bits());
}

}  // namespace halfspace::io
