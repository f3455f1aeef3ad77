#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {
namespace {

/// A solid of polygons, each the numbers of its corners.
Solid solid_of(const std::vector<GridPoint>& vertices,
               const std::vector<std::vector<VertexId>>& polygons) {
  SceneData data;
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

TEST(Merged, FacesThatLookOppositeWaysStay) {
  const Solid sheet =
      solid_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}, {2, 1, 0}});
  EXPECT_EQ(merged(sheet, Merge::kPlane).faces.size(), 2u);
}

/// A block of two cubes, its upper and lower faces in halves, and on the edge
/// between the upper ones, if asked for, a tetrahedron.
Solid block(bool with_tetrahedron) {
  const std::vector<GridPoint> vertices = {
      {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0},
      {2, 1, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, 1, 1},
      {1, 1, 1}, {2, 1, 1}, {0, 0, 3}, {2, 0, 3}};
  std::vector<std::vector<VertexId>> polygons = {
      {0, 3, 4, 1},       {1, 4, 5, 2},         {6, 7, 10, 9}, {7, 8, 11, 10},
      {0, 1, 2, 8, 7, 6}, {3, 9, 10, 11, 5, 4}, {0, 6, 9, 3},  {2, 5, 11, 8}};
  if (with_tetrahedron) {
    for (const auto& face : std::vector<std::vector<VertexId>>{
             {7, 12, 10}, {7, 10, 13}, {7, 13, 12}, {10, 12, 13}})
      polygons.push_back(face);
  }
  return solid_of(vertices, polygons);
}

TEST(Merged, EdgesWhereTheSurfaceTouchesItselfStay) {
  EXPECT_EQ(merged(block(false), Merge::kPlane).faces.size(), 6u);
  EXPECT_EQ(merged(block(true), Merge::kPlane).faces.size(), 7u + 4u);
}

}  // namespace
}  // namespace halfspace::fast
