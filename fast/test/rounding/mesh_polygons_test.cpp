#include "rounding/mesh_polygons.hpp"

#include <gtest/gtest.h>

namespace halfspace::fast {
namespace {

/// A fan of the corners, from the first.
GridMesh fan_of(std::vector<GridPoint> corners) {
  GridMesh mesh;
  mesh.points = std::move(corners);
  mesh.moved.resize(mesh.points.size());
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  for (std::int32_t i = 1; i + 1 < count; ++i)
    mesh.triangles.push_back({{0, i, i + 1}, 0});
  return mesh;
}

TEST(FastMeshPolygons, AFanInAPlaneIsAPolygonAgain) {
  GridMesh mesh =
      fan_of({{0, 0, 0}, {4, 0, 4}, {6, 2, 8}, {6, 5, 11}, {2, 6, 8}});
  const auto polygons = polygons_of(mesh);
  ASSERT_EQ(polygons.size(), 1u);
  EXPECT_EQ(polygons[0].corners.size(), 5u);
}

TEST(FastMeshPolygons, ACornerOffThePlaneKeepsItsTriangleApart) {
  GridMesh mesh =
      fan_of({{0, 0, 0}, {4, 0, 4}, {6, 2, 8}, {6, 5, 11}, {2, 6, 9}});
  EXPECT_EQ(polygons_of(mesh).size(), 2u);
}

TEST(FastMeshPolygons, NoPolygonHasAStraightOrAReflexCorner) {
  // The fan from (2, 2) of a square with straight corners.
  GridMesh mesh =
      fan_of({{2, 2, 0}, {4, 0, 0}, {4, 2, 0}, {4, 4, 0}, {0, 4, 0}});
  for (const MeshPolygon& polygon : polygons_of(mesh))
    EXPECT_LT(polygon.corners.size(), 5u);
  // A dart.
  GridMesh dart = fan_of({{0, 0, 0}, {9, -9, 0}, {3, 0, 0}, {9, 9, 0}});
  EXPECT_EQ(polygons_of(dart).size(), 2u);
}

TEST(FastMeshPolygons, SourcesAreNotMixed) {
  GridMesh mesh = fan_of({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  mesh.triangles[0].source = 1;
  const auto polygons = polygons_of(mesh);
  ASSERT_EQ(polygons.size(), 2u);
  EXPECT_EQ(polygons[0].source, 0);
  EXPECT_EQ(polygons[1].source, 1);
}

}  // namespace
}  // namespace halfspace::fast
