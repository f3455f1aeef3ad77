#include "views.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "halfspace/assert.hpp"
#include "scenes.hpp"

namespace halfspace::bench {
namespace {

LatticeVector to_lattice(const glm::dvec3& v) {
  constexpr double kSteps = 1 << kLatticeBits;
  const auto round = [](double steps) {
    return static_cast<Int128>(std::round(steps * kSteps));
  };
  return {round(v.x), round(v.y), round(v.z)};
}

/// From the target towards the eye.
glm::dvec3 direction_of(View view) {
  switch (view) {
    case View::kFront:
      return {0, 0, -1};
    case View::kBack:
      return {0, 0, 1};
    case View::kLeft:
      return {-1, 0, 0};
    case View::kRight:
      return {1, 0, 0};
    case View::kTop:
      return {0, 1, 0};
    case View::kBottom:
      return {0, -1, 0};
    case View::kCorner:
      return {1, 1, 1};
    case View::kAskew:
      return {-0.613, 0.327, -0.719};
  }
  return {};
}

/// A square image, `width` wide at the target. Units: grid steps.
Camera look_at(const glm::dvec3& target, View view, double distance,
               double width, std::int32_t size_px, int grid_bits) {
  const glm::dvec3 back = glm::normalize(direction_of(view));
  const glm::dvec3 up =
      std::abs(back.y) > 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(up, back));
  const glm::dvec3 down = -glm::cross(back, right);
  CameraData data;
  data.eye = to_lattice(target + distance * back);
  data.sx = to_lattice(right * (width / size_px));
  data.sy = to_lattice(down * (width / size_px));
  data.s0 = to_lattice(target - right * (width / 2) - down * (width / 2));
  data.width_px = size_px;
  data.height_px = size_px;
  Result<Camera> camera = make_camera(data, grid_bits);
  HALFSPACE_ASSERT(camera.has_value());
  return *camera;
}

}  // namespace

std::optional<View> view_named(std::string_view name) {
  const auto* const found =
      std::find(kViewNames.begin(), kViewNames.end(), name);
  if (found == kViewNames.end()) return std::nullopt;
  return kViews[static_cast<std::size_t>(found - kViewNames.begin())];
}

Camera universe_camera(View view, std::int32_t size_px) {
  constexpr double kSide = kUniverse * kStepsPerUnit;
  return look_at({0, 0, 0}, view, 2 * kSide, 1.33 * kSide, size_px, 26);
}

Camera universe_camera(const Scene& scene, View view, std::int32_t size_px) {
  const double side = std::ldexp(kUniverse, -scene.unit().exponent);
  return look_at({0, 0, 0}, view, 2 * side, 1.33 * side, size_px,
                 scene.grid_bits());
}

Camera scene_camera(const Scene& scene, View view, std::int32_t size_px) {
  const auto to_vec = [](const GridPoint& p) {
    return glm::dvec3(static_cast<double>(p.x), static_cast<double>(p.y),
                      static_cast<double>(p.z));
  };
  const std::vector<GridPoint>& vertices = scene.data().vertices;
  HALFSPACE_ASSERT(!vertices.empty());
  glm::dvec3 low = to_vec(vertices.front());
  glm::dvec3 high = low;
  for (const GridPoint& vertex : vertices) {
    const glm::dvec3 p = to_vec(vertex);
    low = glm::dvec3(std::min(low.x, p.x), std::min(low.y, p.y),
                     std::min(low.z, p.z));
    high = glm::dvec3(std::max(high.x, p.x), std::max(high.y, p.y),
                      std::max(high.z, p.z));
  }
  const glm::dvec3 centre = (low + high) / 2.0;
  double radius = 1;
  for (const GridPoint& vertex : vertices) {
    radius = std::max(radius, glm::length(to_vec(vertex) - centre));
  }
  // Seen from 3 radii away, a sphere's outline is where its tangents meet the
  // plane through its centre: at 3 / sqrt(3^2 - 1) of its radius.
  const double width = 2 * radius * 3 / std::sqrt(8.0);
  return look_at(centre, view, 3 * radius, width, size_px, scene.grid_bits());
}

}  // namespace halfspace::bench
