#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

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
  auto scene = make_scene(std::move(data));
  EXPECT_TRUE(scene) << scene.error().message;
  auto solid = make_solid(*std::move(scene));
  EXPECT_TRUE(solid) << solid.error().message;
  return to_solid(*solid);
}

}  // namespace halfspace::fast
