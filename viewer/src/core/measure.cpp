#include "core/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/combine.hpp"
#include "core/moves.hpp"

namespace halfspace::viewer {

using glm::dvec2;
using glm::dvec3;

std::optional<dvec2> projected(const io::ViewOptions& camera,
                               const dvec3& point) {
  const CameraAxes axes = axes_of(camera);
  const dvec3 from_eye = point - camera.eye;
  const double depth = -glm::dot(from_eye, axes.back);
  double px_per_unit = camera.height_px;
  if (camera.orthographic) {
    px_per_unit /= camera.ortho_height;
  } else {
    if (!(depth > 0)) return std::nullopt;
    px_per_unit /=
        2 * depth * std::tan(camera.fov_deg * std::numbers::pi / 360);
  }
  return dvec2(camera.width_px / 2.0, camera.height_px / 2.0) +
         px_per_unit * dvec2(glm::dot(from_eye, axes.right),
                             -glm::dot(from_eye, axes.up));
}

double angle_deg(const dvec3& a, const dvec3& apex, const dvec3& b) {
  const dvec3 u = a - apex, v = b - apex;
  const double sine = glm::length(glm::cross(u, v));
  const double cosine = glm::dot(u, v);
  return sine == 0 && cosine == 0
             ? 0
             : std::atan2(sine, cosine) * 180 / std::numbers::pi;
}

double triangle_area(const dvec3& a, const dvec3& b, const dvec3& c) {
  return glm::length(glm::cross(b - a, c - a)) / 2;
}

Result<std::string> measures_of(const State& state, const Report& report) {
  const Solid solid = solid_of(state);
  WorkOptions options;
  options.progress = [&report](double share) {
    return report("measuring", share);
  };
  const auto done = solid.evaluate(options);
  if (!done) return done.error();
  const auto volume = solid.exact_volume();
  if (!volume) return volume.error();
  const auto area = solid.area();
  if (!area) return area.error();
  const auto exact_area = solid.exact_area();
  const auto bounds = solid.bounds();
  if (!bounds) return bounds.error();
  const Point& low = bounds->low;
  const Point& high = bounds->high;
  return fmt::format(
      "volume {} = {}\narea {}{}\nbox {:.6g} x {:.6g} x {:.6g}",
      *solid.volume(), *volume, *area,
      exact_area && *exact_area ? " = " + **exact_area : std::string(),
      high.x - low.x, high.y - low.y, high.z - low.z);
}

}  // namespace halfspace::viewer
