#pragma once

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>

#include "halfspace/io/view.hpp"

/// What the tests of views look at.
namespace halfspace::io::samples {

using glm::dvec3;

/// A scene of one triangle that fills a box.
inline Scene box_scene(Unit unit, std::int64_t size, int bits,
                       GridPoint at = {0, 0, 0}) {
  SceneData data;
  data.unit = unit;
  data.grid_bits = bits;
  data.vertices = {{at.x, at.y, at.z},
                   {at.x + size, at.y, at.z + size},
                   {at.x, at.y + size, at.z + size}};
  data.first_corner = {0, 3};
  data.corners = {0, 1, 2};
  data.colors = {{}};
  const Result<Scene> scene = make_scene(data);
  EXPECT_TRUE(scene) << scene.error().message;
  return scene ? *scene : Scene{};
}

inline dvec3 vector(const LatticeVector& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y),
          static_cast<double>(v.z)};
}

/// The image point that sees a point of the lattice; nothing behind the eye.
inline dvec3 image_of(const CameraData& camera, const dvec3& point) {
  // point - origin = a (s0 - origin') + b sx + c sy, by Cramer's rule.
  const dvec3 sx = vector(camera.sx);
  const dvec3 sy = vector(camera.sy);
  const dvec3 eye = vector(camera.eye);
  const dvec3 s0 = vector(camera.s0);
  const dvec3 w = camera.perspective ? s0 - eye : eye;
  const dvec3 p = camera.perspective ? point - eye : point - s0;
  const double all = glm::dot(w, glm::cross(sx, sy));
  const double a = glm::dot(p, glm::cross(sx, sy)) / all;
  const double b = glm::dot(w, glm::cross(p, sy)) / all;
  const double c = glm::dot(w, glm::cross(sx, p)) / all;
  return camera.perspective ? dvec3{b / a, c / a, a} : dvec3{b, c, -a};
}

/// The corners of an image of so many pixels.
inline std::array<dvec3, 4> corners_of(const CameraData& camera, int width_px,
                                       int height_px) {
  const dvec3 s0 = vector(camera.s0);
  const dvec3 across = static_cast<double>(width_px) * vector(camera.sx);
  const dvec3 down = static_cast<double>(height_px) * vector(camera.sy);
  return {s0, s0 + across, s0 + down, s0 + across + down};
}

}  // namespace halfspace::io::samples
