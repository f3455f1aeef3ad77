#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "halfspace/assert.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

using Ids = std::vector<PolygonId>;

/// The polygons of a scene, by their corners.
using Polygons = std::vector<std::vector<GridPoint>>;

/// The scene of these polygons.
/// Requires: each is valid; colours, if there are any, are one a corner.
inline Scene scene_of(const Polygons& polygons,
                      std::vector<Rgb> corner_colors = {}, int grid_bits = 26) {
  SceneData data;
  data.grid_bits = grid_bits;
  for (const std::vector<GridPoint>& polygon : polygons) {
    for (const GridPoint& corner : polygon) {
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
      data.vertices.push_back(corner);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    const auto shade = static_cast<std::uint8_t>(data.colors.size());
    data.colors.push_back({shade, 10, 20});
  }
  data.corner_colors = std::move(corner_colors);
  const Result<Scene> scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  return *scene;
}

inline Camera camera_of(const CameraData& data, int grid_bits = 26) {
  const Result<Camera> camera = make_camera(data, grid_bits);
  HALFSPACE_ASSERT(camera.has_value());
  return *camera;
}

/// A camera at z = infinity that sees the grid point (i, j, z) at the very
/// centre of pixel (i, j), whatever z is.
inline CameraData from_above(std::int32_t width_px, std::int32_t height_px) {
  CameraData data;
  data.perspective = false;
  data.eye = {0, 0, 256};
  data.s0 = {-128, -128, 0};
  data.sx = {256, 0, 0};
  data.sy = {0, 256, 0};
  data.width_px = width_px;
  data.height_px = height_px;
  return data;
}

}  // namespace halfspace::ref
