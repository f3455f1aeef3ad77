#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <vector>

#include "halfspace/io/number.hpp"
#include "halfspace/io/view.hpp"
#include "view/vectors.hpp"

namespace halfspace::io {
namespace {

using glm::dvec3;

constexpr double kFieldDeg = 30;
/// A margin of 4 in a hundred round what is farthest out.
constexpr double kMargin = 1.04;

double step_of(const Scene& scene) {
  const Unit unit = scene.unit();
  return to_double({1, unit.exponent, unit.base == 10 ? unit.exponent : 0});
}

/// The vertices that polygons have, as doubles. Units: grid steps.
std::vector<dvec3> points_of(const Scene& scene) {
  std::vector<bool> is_used(scene.data().vertices.size());
  for (const VertexId corner : scene.data().corners)
    is_used[static_cast<std::size_t>(corner)] = true;
  std::vector<dvec3> points;
  points.reserve(is_used.size());
  for (std::size_t v = 0; v < is_used.size(); ++v) {
    const GridPoint& p = scene.data().vertices[v];
    if (is_used[v]) points.emplace_back(p.x, p.y, p.z);
  }
  return points;
}

dvec3 middle_of_points(const std::vector<dvec3>& points) {
  dvec3 least = points[0];
  dvec3 most = points[0];
  for (const dvec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], point[axis]);
      most[axis] = std::max(most[axis], point[axis]);
    }
  }
  return (least + most) / 2.0;
}

/// A point from the side of the view: how far it is along the image's axis,
/// and how far towards the eye.
struct Seen {
  double along;
  double towards;
};

/// One axis of the image: the eye's place and the least distance at which all
/// points are within a tangent of half the field.
struct Fit {
  double at = 0;
  double distance = 0;
};

/// Each side of the field is a line that no point may pass: the eye is where
/// the two lines meet.
Fit fitted(const std::vector<Seen>& points, double tangent) {
  const double steep = kMargin / tangent;
  double right = std::numeric_limits<double>::lowest();
  double left = right;
  for (const auto& [along, towards] : points) {
    right = std::max(right, towards + steep * along);
    left = std::max(left, towards - steep * along);
  }
  return {(right - left) / (2 * steep), (right + left) / 2};
}

/// Where the eye is in the middle of what it sees from a distance. Exchanges
/// the two outermost points until they stay.
double centred(const std::vector<Seen>& points, double at, double distance) {
  constexpr int kMostExchanges = 8;
  for (int k = 0; k < kMostExchanges; ++k) {
    // The first of the least and the last of the greatest slopes: each is
    // found once, for a division takes longer than all else.
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    const Seen* low = &points.front();
    const Seen* high = low;
    for (const Seen& p : points) {
      const double slope = (p.along - at) / (distance - p.towards);
      if (slope < least) {
        least = slope;
        low = &p;
      }
      if (slope >= most) {
        most = slope;
        high = &p;
      }
    }
    const double u = distance - low->towards;
    const double v = distance - high->towards;
    const double next = (high->along * u + low->along * v) / (u + v);
    if (next == at) break;
    at = next;
  }
  return at;
}

std::vector<Seen> seen_along(const std::vector<dvec3>& points,
                             const dvec3& middle, const dvec3& axis,
                             const dvec3& to_eye) {
  std::vector<Seen> seen;
  seen.reserve(points.size());
  for (const dvec3& point : points)
    seen.push_back(
        {glm::dot(point - middle, axis), glm::dot(point - middle, to_eye)});
  return seen;
}

/// The same in parallel rays: the middle, and half of the size.
Fit fitted_parallel(const std::vector<Seen>& points) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(),
      [](const Seen& p, const Seen& q) { return p.along < q.along; });
  return {(low->along + high->along) / 2, (high->along - low->along) / 2};
}

}  // namespace

dvec3 middle_of(const Scene& scene) {
  return step_of(scene) * middle_of_points(points_of(scene));
}

ViewDirection turned(const ViewDirection& direction, const dvec3& up) {
  const dvec3 z = {0, 0, 1};
  const dvec3 to = unit_vector(up);
  const double cosine = glm::dot(z, to);
  // Straight down is a half turn about x.
  const dvec3 axis = cosine < -1 + 1e-12 ? dvec3(1, 0, 0) : glm::cross(z, to);
  const double sine = glm::length(axis);
  const auto turn = [&](const dvec3& v) {
    if (cosine < -1 + 1e-12) return dvec3(v.x, -v.y, -v.z);
    if (sine == 0) return v;
    const dvec3 unit = axis / sine;
    return v * cosine + glm::cross(unit, v) * sine +
           unit * glm::dot(unit, v) * (1 - cosine);
  };
  return {turn(direction.to_eye), turn(direction.up)};
}

Result<ViewOptions> automatic_options(const Scene& scene,
                                      const ViewDirection& direction,
                                      std::int32_t width_px,
                                      std::int32_t height_px,
                                      bool orthographic) {
  if (scene.polygon_count() == 0)
    return Error{ErrorCode::kEmpty, "the scene has no polygons to look at"};
  const dvec3 to_eye = unit_vector(direction.to_eye);
  const dvec3 across = glm::cross(unit_vector(direction.up), to_eye);
  if (!(glm::length(across) > 1e-9)) {
    return Error{ErrorCode::kBadCamera,
                 "the camera's up is zero or along its direction of view"};
  }
  const std::vector<dvec3> points = points_of(scene);
  const dvec3 middle = middle_of_points(points);
  const dvec3 right = glm::normalize(across);
  const dvec3 above = glm::cross(to_eye, right);
  const auto columns = seen_along(points, middle, right, to_eye);
  const auto rows = seen_along(points, middle, above, to_eye);

  const double tan_y = std::tan(glm::radians(kFieldDeg) / 2);
  const double tan_x = tan_y * width_px / height_px;
  const Fit x = fitted(columns, tan_x);
  const Fit y = fitted(rows, tan_y);
  const double distance = std::max(x.distance, y.distance);
  const Fit column = fitted_parallel(columns);
  const Fit row = fitted_parallel(rows);
  const double at_x =
      orthographic ? column.at : centred(columns, x.at, distance);
  const double at_y = orthographic ? row.at : centred(rows, y.at, distance);
  const dvec3 target = middle + at_x * right + at_y * above;
  // A polygon seen from its edge still has a picture.
  constexpr double kLeastShare = 1e-3;
  const double height =
      2 * kMargin *
      std::max({row.distance, column.distance * height_px / width_px,
                kLeastShare * distance});
  const double step = step_of(scene);
  ViewOptions options;
  options.target = step * target;
  options.eye = step * (target + distance * to_eye);
  options.up = direction.up;
  options.fov_deg = kFieldDeg;
  options.orthographic = orthographic;
  options.ortho_height = step * height;
  options.width_px = width_px;
  options.height_px = height_px;
  return options;
}

Result<Viewed> automatic_view(const Scene& scene, std::int32_t width_px,
                              std::int32_t height_px) {
  const Result<ViewOptions> options =
      automatic_options(scene, ViewDirection(), width_px, height_px);
  if (!options) return options.error();
  return look_at(scene, *options);
}

}  // namespace halfspace::io
