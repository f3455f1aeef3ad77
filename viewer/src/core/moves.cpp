#include "core/moves.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

namespace halfspace::viewer {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kHalfTurn = std::numbers::pi;

double radians(double degrees) { return degrees * kHalfTurn / 180; }

/// v turned about an axis of length 1, counterclockwise.
dvec3 turned_about(const dvec3& v, const dvec3& axis, double angle) {
  return glm::angleAxis(angle, axis) * v;
}

/// Turns eye and up about the target.
io::ViewOptions turned_camera(io::ViewOptions camera, const dvec3& axis,
                              double angle) {
  const CameraAxes axes = axes_of(camera);
  const double distance = glm::distance(camera.eye, camera.target);
  camera.eye = camera.target + distance * turned_about(axes.back, axis, angle);
  camera.up = turned_about(axes.up, axis, angle);
  return camera;
}

double model_per_px(const io::ViewOptions& camera) {
  return height_at_target(camera) / camera.height_px;
}

/// The same at the distance of a point.
double model_per_px_at(const io::ViewOptions& camera, const dvec3& point) {
  if (camera.orthographic) return model_per_px(camera);
  const dvec3 forward = glm::normalize(camera.target - camera.eye);
  return model_per_px(camera) * glm::dot(point - camera.eye, forward) /
         glm::distance(camera.target, camera.eye);
}

}  // namespace

CameraAxes axes_of(const io::ViewOptions& camera) {
  CameraAxes axes;
  axes.back = glm::normalize(camera.eye - camera.target);
  axes.right = glm::normalize(glm::cross(camera.up, axes.back));
  axes.up = glm::cross(axes.back, axes.right);
  return axes;
}

double height_at_target(const io::ViewOptions& camera) {
  if (camera.orthographic) return camera.ortho_height;
  return 2 * glm::distance(camera.eye, camera.target) *
         std::tan(radians(camera.fov_deg) / 2);
}

io::ViewOptions orbited(const io::ViewOptions& camera, dvec2 drag,
                        const dvec3& axis) {
  const double per_px = kHalfTurn / camera.height_px;
  const dvec3 pole = glm::normalize(axis);
  const CameraAxes axes = axes_of(camera);
  // Upside down the table turns the other way under the hand.
  const double upright = glm::dot(axes.up, pole) < -1e-9 ? -1 : 1;
  // The angle between the pole and the direction to the eye, which a drag
  // changes until it is 0 or a half turn.
  const double now =
      std::acos(std::clamp(glm::dot(axes.back, pole), -1.0, 1.0));
  const double asked = now - upright * drag.y * per_px;
  const double angle = std::clamp(asked, 0.0, kHalfTurn) - now;
  io::ViewOptions result = turned_camera(camera, axes.right, upright * angle);
  return turned_camera(result, pole, -upright * drag.x * per_px);
}

io::ViewOptions rolled(const io::ViewOptions& camera, dvec2 drag) {
  const double length = glm::length(drag);
  if (length == 0) return camera;
  const CameraAxes axes = axes_of(camera);
  const dvec3 axis = glm::normalize(-drag.y * axes.right - drag.x * axes.up);
  return turned_camera(camera, axis, length * kHalfTurn / camera.height_px);
}

io::ViewOptions twisted(const io::ViewOptions& camera, double degrees) {
  return turned_camera(camera, axes_of(camera).back, -radians(degrees));
}

io::ViewOptions panned(const io::ViewOptions& camera, dvec2 drag) {
  const CameraAxes axes = axes_of(camera);
  const dvec3 by =
      model_per_px(camera) * (-drag.x * axes.right + drag.y * axes.up);
  io::ViewOptions result = camera;
  result.eye += by;
  result.target += by;
  return result;
}

dvec3 dragged(const io::ViewOptions& camera, const dvec3& point, dvec2 drag) {
  const CameraAxes axes = axes_of(camera);
  return model_per_px_at(camera, point) *
         (drag.x * axes.right - drag.y * axes.up);
}

double dragged_along(const io::ViewOptions& camera, const dvec3& point,
                     const dvec3& axis, dvec2 drag) {
  // Shorter than this in the picture, it is seen from its end.
  constexpr double kLeastShare = 0.15;
  const CameraAxes axes = axes_of(camera);
  const dvec2 seen(glm::dot(axis, axes.right), -glm::dot(axis, axes.up));
  const double scale = model_per_px_at(camera, point);
  if (glm::length(seen) < kLeastShare) return -scale * drag.y;
  return scale * glm::dot(drag, seen) / glm::dot(seen, seen);
}

io::ViewOptions zoomed(const io::ViewOptions& camera, double factor,
                       dvec2 cursor) {
  const CameraAxes axes = axes_of(camera);
  const dvec2 from_middle =
      cursor - 0.5 * dvec2(camera.width_px, camera.height_px);
  const dvec3 point =
      camera.target + model_per_px(camera) * (from_middle.x * axes.right -
                                              from_middle.y * axes.up);
  io::ViewOptions result = camera;
  result.target = point + factor * (camera.target - point);
  if (camera.orthographic) {
    result.ortho_height *= factor;
    result.eye += result.target - camera.target;
  } else {
    result.eye = point + factor * (camera.eye - point);
  }
  return result;
}

io::ViewOptions with_projection(const io::ViewOptions& camera,
                                bool orthographic) {
  io::ViewOptions result = camera;
  if (orthographic) {
    result.ortho_height = height_at_target(camera);
  } else if (camera.orthographic) {
    const double distance =
        camera.ortho_height / (2 * std::tan(radians(camera.fov_deg) / 2));
    result.eye = camera.target + distance * axes_of(camera).back;
  }
  result.orthographic = orthographic;
  return result;
}

io::ViewOptions with_field(const io::ViewOptions& camera, double fov_deg) {
  io::ViewOptions result = camera;
  result.fov_deg = fov_deg;
  if (camera.orthographic) return result;
  const double distance =
      height_at_target(camera) / (2 * std::tan(radians(fov_deg) / 2));
  result.eye = camera.target + distance * axes_of(camera).back;
  return result;
}

Result<io::ViewOptions> fitted(const Scene& scene,
                               const io::ViewOptions& camera) {
  const CameraAxes axes = axes_of(camera);
  return fitted(scene, camera, {axes.back, axes.up});
}

Result<io::ViewOptions> fitted(const Scene& scene,
                               const io::ViewOptions& camera,
                               const io::ViewDirection& direction) {
  Result<io::ViewOptions> fit = io::automatic_options(
      scene, direction, camera.width_px, camera.height_px, camera.orthographic);
  if (!fit) return fit;
  fit->near = camera.near;
  return camera.orthographic ? *fit : with_field(*fit, camera.fov_deg);
}

io::ViewOptions between(const io::ViewOptions& from, const io::ViewOptions& to,
                        double share) {
  if (share >= 1) return to;
  const auto turn_of = [](const io::ViewOptions& camera) {
    const CameraAxes axes = axes_of(camera);
    return glm::quat_cast(glm::dmat3(axes.right, axes.up, axes.back));
  };
  const glm::dquat turn =
      glm::slerp(turn_of(from), turn_of(to), std::max(share, 0.0));
  const auto mixed = [share](double a, double b) {
    return a > 0 && b > 0
               ? std::exp((1 - share) * std::log(a) + share * std::log(b))
               : b;
  };
  io::ViewOptions result = to;
  result.target = from.target + share * (to.target - from.target);
  result.eye = result.target + mixed(glm::distance(from.eye, from.target),
                                     glm::distance(to.eye, to.target)) *
                                   (turn * dvec3(0, 0, 1));
  result.up = turn * dvec3(0, 1, 0);
  result.ortho_height = mixed(from.ortho_height, to.ortho_height);
  return result;
}

}  // namespace halfspace::viewer
