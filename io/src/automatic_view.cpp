#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "halfspace/io/number.hpp"
#include "halfspace/io/view.hpp"

namespace halfspace::io {
namespace {

using glm::dvec3;

/// From the scene to the eye: to the right, in front and above.
constexpr dvec3 kToEye = {0.45, -0.78, 0.42};
constexpr double kFieldDeg = 30;
constexpr double kMargin = 1.04;

/// The corners of the polygons, as doubles.
std::vector<dvec3> points_of(const Scene& scene) {
  std::vector<dvec3> points;
  for (const VertexId corner : scene.data().corners) {
    const GridPoint& p = scene.point(corner);
    points.emplace_back(p.x, p.y, p.z);
  }
  return points;
}

}  // namespace

Result<Viewed> automatic_view(const Scene& scene, std::int32_t width_px,
                              std::int32_t height_px) {
  if (scene.polygon_count() == 0) {
    return Error{ErrorCode::kEmpty, "the scene has no polygons to look at"};
  }
  const std::vector<dvec3> points = points_of(scene);
  dvec3 least = points[0];
  dvec3 most = points[0];
  for (const dvec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], point[axis]);
      most[axis] = std::max(most[axis], point[axis]);
    }
  }
  const dvec3 middle = (least + most) / 2.0;
  const dvec3 to_eye = glm::normalize(kToEye);
  const dvec3 up = {0, 0, 1};
  const dvec3 right = glm::normalize(glm::cross(up, to_eye));
  const dvec3 above = glm::cross(to_eye, right);

  // The least distance at which every point is inside the image.
  const double tan_y = std::tan(glm::radians(kFieldDeg) / 2);
  const double tan_x = tan_y * width_px / height_px;
  double distance = 0;
  for (const dvec3& point : points) {
    const dvec3 from_middle = point - middle;
    const double towards = glm::dot(from_middle, to_eye);
    distance = std::max(
        {distance,
         towards + kMargin * std::abs(glm::dot(from_middle, right)) / tan_x,
         towards + kMargin * std::abs(glm::dot(from_middle, above)) / tan_y});
  }
  const Unit unit = scene.unit();
  const double step =
      to_double({1, unit.exponent, unit.base == 10 ? unit.exponent : 0});
  ViewOptions options;
  options.target = step * middle;
  options.eye = step * (middle + distance * to_eye);
  options.up = up;
  options.fov_deg = kFieldDeg;
  options.width_px = width_px;
  options.height_px = height_px;
  return look_at(scene, options);
}

}  // namespace halfspace::io
