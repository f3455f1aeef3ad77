#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// Adds a polygon whose corners are vertices of its own.
inline void add_polygon(SceneData& data, const std::vector<GridPoint>& corners,
                        const Rgb& color = {}) {
  for (const GridPoint& p : corners) {
    data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
    data.vertices.push_back(p);
  }
  data.first_corner.push_back(static_cast<std::uint32_t>(data.corners.size()));
  data.colors.push_back(color);
}

/// The scene. Requires: it is valid.
inline Scene made(SceneData data) {
  Result<Scene> scene = make_scene(std::move(data));
  EXPECT_TRUE(scene) << scene.error().message;
  return *std::move(scene);
}

/// A solid of polygons, each the numbers of its corners.
inline Solid solid_of(const std::vector<GridPoint>& vertices,
                      const std::vector<std::vector<VertexId>>& polygons) {
  SceneData data;
  data.unit = {10, -3};
  data.vertices = vertices;
  for (const auto& corners : polygons) {
    data.corners.insert(data.corners.end(), corners.begin(), corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({});
  }
  auto solid = make_solid(made(std::move(data)));
  EXPECT_TRUE(solid) << solid.error().message;
  return to_solid(*solid);
}

}  // namespace halfspace::fast
