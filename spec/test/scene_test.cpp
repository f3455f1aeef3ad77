#include "halfspace/scene.hpp"

#include <gtest/gtest.h>

namespace halfspace {
namespace {

/// A scene of one polygon with these vertices.
SceneData one_polygon(std::vector<GridPoint> vertices, int grid_bits = 26) {
  SceneData data;
  data.grid_bits = grid_bits;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    data.corners.push_back(static_cast<VertexId>(i));
  }
  data.vertices = std::move(vertices);
  data.first_corner.push_back(static_cast<std::uint32_t>(data.corners.size()));
  data.colors.push_back({});
  return data;
}

ErrorCode code_of(const Result<Scene>& scene) {
  return scene ? static_cast<ErrorCode>(-1) : scene.error().code;
}

TEST(MakeScene, AcceptsATriangleAtTheLimitsOfEveryGrid) {
  for (const int bits : kGridBits) {
    const std::int64_t least = -(std::int64_t{1} << (bits - 1));
    const std::int64_t most = -least - 1;
    EXPECT_TRUE(make_scene(one_polygon(
        {{least, least, least}, {most, most, least}, {least, most, most}},
        bits)));
    EXPECT_EQ(code_of(make_scene(one_polygon(
                  {{0, 0, 0}, {most + 1, 0, 0}, {0, 1, 0}}, bits))),
              ErrorCode::kOutOfRange);
  }
}

TEST(MakeScene, TellsAPointOneStepOffThePlaneAtTheLimitsOfEveryGrid) {
  for (const int bits : kGridBits) {
    const std::int64_t a = (std::int64_t{1} << (bits - 1)) - 1;
    EXPECT_TRUE(make_scene(
        one_polygon({{-a, -a, a}, {a, -a, -a}, {a, a, -a}, {-a, a, a}}, bits)));
    EXPECT_EQ(
        code_of(make_scene(one_polygon(
            {{-a, -a, a}, {a, -a, -a}, {a, a, -a}, {-a, a, a - 1}}, bits))),
        ErrorCode::kNotPlanar);
  }
}

TEST(MakeScene, AcceptsStraightCornersEvenAtTheStart) {
  EXPECT_TRUE(make_scene(
      one_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}})));
}

TEST(MakeScene, NamesWhatIsWrongWithAPolygon) {
  EXPECT_EQ(code_of(make_scene(one_polygon({{0, 0, 0}, {1, 0, 0}}))),
            ErrorCode::kTooFewVertices);
  EXPECT_EQ(code_of(make_scene(one_polygon(
                {{0, 0, 0}, {4, 0, 0}, {0, 0, 0}, {0, 4, 0}}))),
            ErrorCode::kRepeatedVertex);
  EXPECT_EQ(
      code_of(make_scene(one_polygon({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}))),
      ErrorCode::kZeroArea);
  EXPECT_EQ(code_of(make_scene(one_polygon(
                {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}))),
            ErrorCode::kNotConvex);
  // A spike: straight, but back the way it came.
  EXPECT_EQ(code_of(make_scene(one_polygon(
                {{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 4, 0}}))),
            ErrorCode::kNotConvex);
}

TEST(MakeScene, RefusesAStarThatTurnsOneWayButTwiceRound) {
  EXPECT_EQ(code_of(make_scene(one_polygon({{0, 10, 0},
                                            {-6, -8, 0},
                                            {10, 3, 0},
                                            {-10, 3, 0},
                                            {6, -8, 0}}))),
            ErrorCode::kNotConvex);
}

}  // namespace
}  // namespace halfspace
