#include "halfspace/scene.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

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
    EXPECT_EQ(code_of(make_scene(
                  one_polygon({{0, 0, 0}, {most + 1, 0, 0}, {0, 1, 0}}, bits))),
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

/// What is computed of these is a power of two that narrower integers take for
/// zero: the areas have 78 and 106 bits, the volume 160.
TEST(MakeScene, UsesIntegersWideEnoughForPowersOfTwo) {
  for (const int bits : {40, 54}) {
    const std::int64_t a = -(std::int64_t{1} << (bits - 1));
    EXPECT_TRUE(
        make_scene(one_polygon({{a, a, a}, {0, a, a}, {0, 0, a}}, bits)));
    EXPECT_EQ(code_of(make_scene(one_polygon(
                  {{a, a, a}, {0, a, a}, {0, 0, a}, {a, 0, 0}}, bits))),
              ErrorCode::kNotPlanar);
  }
}

TEST(MakeScene, LooksForAnAreaInThePolygonsOwnCornersOnly) {
  SceneData data = one_polygon({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}});
  data.vertices.push_back({9, 0, 0});
  data.corners.insert(data.corners.end(), {4, 1, 2});
  data.first_corner.push_back(7);
  data.colors.push_back({});
  EXPECT_EQ(code_of(make_scene(data)), ErrorCode::kZeroArea);
}

TEST(MakeScene, AcceptsStraightCornersEvenAtTheStart) {
  EXPECT_TRUE(make_scene(
      one_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}})));
}

TEST(MakeScene, AcceptsManyStraightCornersOnAnEdge) {
  for (const std::int64_t side : {-3, 3}) {
    EXPECT_TRUE(make_scene(one_polygon({{0, 0, 0},
                                        {1, 1, 0},
                                        {2, 2, 0},
                                        {7, 7, 0},
                                        {9, 9, 0},
                                        {0, side, 3},
                                        {0, side / 3, 1}})));
  }
}

TEST(MakeScene, NamesWhatIsWrongWithAPolygon) {
  EXPECT_EQ(code_of(make_scene(one_polygon({{0, 0, 0}, {1, 0, 0}}))),
            ErrorCode::kTooFewVertices);
  EXPECT_EQ(code_of(make_scene(
                one_polygon({{0, 0, 0}, {4, 0, 0}, {0, 0, 0}, {0, 4, 0}}))),
            ErrorCode::kRepeatedVertex);
  EXPECT_EQ(code_of(make_scene(one_polygon({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}))),
            ErrorCode::kZeroArea);
  EXPECT_EQ(code_of(make_scene(
                one_polygon({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}))),
            ErrorCode::kNotConvex);
  // A spike: straight, but back the way it came.
  EXPECT_EQ(code_of(make_scene(
                one_polygon({{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 4, 0}}))),
            ErrorCode::kNotConvex);
}

TEST(MakeScene, RefusesAStarThatTurnsOneWayButTwiceRound) {
  EXPECT_EQ(
      code_of(make_scene(one_polygon(
          {{0, 10, 0}, {-6, -8, 0}, {10, 3, 0}, {-10, 3, 0}, {6, -8, 0}}))),
      ErrorCode::kNotConvex);
}

TEST(MakeScene, RefusesArraysWhoseSizesDisagree) {
  const auto changed = [](auto&& change) {
    SceneData data = one_polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    change(data);
    return make_scene(std::move(data));
  };
  const auto refused = [&](auto&& change) {
    const Result<Scene> scene = changed(change);
    return code_of(scene) == ErrorCode::kOutOfRange &&
           scene.error().message ==
               "the sizes of the scene's arrays disagree" &&
           scene.error().index == -1;
  };
  EXPECT_TRUE(changed([](SceneData&) {}));
  EXPECT_TRUE(refused([](SceneData& data) { data.first_corner.clear(); }));
  EXPECT_TRUE(refused([](SceneData& data) { data.first_corner[0] = 1; }));
  EXPECT_TRUE(refused([](SceneData& data) { data.first_corner[1] = 2; }));
  EXPECT_TRUE(refused([](SceneData& data) { data.first_corner[1] = 4; }));
  EXPECT_TRUE(refused([](SceneData& data) {
    data.first_corner = {0, 4, 3};
    data.colors.resize(2);
  }));
  EXPECT_TRUE(refused([](SceneData& data) { data.colors.clear(); }));
  EXPECT_TRUE(refused([](SceneData& data) { data.colors.resize(2); }));
  EXPECT_TRUE(refused([](SceneData& data) { data.corner_colors.resize(2); }));
  EXPECT_TRUE(refused([](SceneData& data) { data.corner_colors.resize(4); }));
  EXPECT_TRUE(changed([](SceneData& data) { data.corner_colors.resize(3); }));
}

TEST(MakeScene, RefusesUnknownGridsAndUnits) {
  for (const int bits : {0, 25, 27, 32, 39, 41, 53, 55, 64}) {
    const Result<Scene> scene = make_scene(one_polygon({}, bits));
    EXPECT_EQ(code_of(scene), ErrorCode::kOutOfRange);
    EXPECT_EQ(scene.error().message,
              "a grid has 26, 40 or 54 bits, not " + std::to_string(bits));
  }
  const auto with_unit = [](Unit unit) {
    SceneData data = one_polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    data.unit = unit;
    return make_scene(std::move(data));
  };
  for (const std::int32_t base : {2, 10}) {
    for (const std::int32_t exponent : {-4096, -1, 0, 4096}) {
      EXPECT_TRUE(with_unit({base, exponent}));
    }
    for (const std::int32_t exponent : {-4097, 4097}) {
      EXPECT_EQ(code_of(with_unit({base, exponent})), ErrorCode::kOutOfRange);
    }
  }
  for (const std::int32_t base : {-2, 0, 1, 3, 9, 11}) {
    EXPECT_EQ(code_of(with_unit({base, 0})), ErrorCode::kOutOfRange);
  }
  EXPECT_EQ(with_unit({3, -7}).error().message,
            "a unit is a power of 2 or 10 with an exponent from -4096 to 4096, "
            "not 3^-7");
}

TEST(MakeScene, NamesTheVertexOffTheGrid) {
  for (std::int64_t GridPoint::*const axis :
       {&GridPoint::x, &GridPoint::y, &GridPoint::z}) {
    SceneData data = one_polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    for (std::size_t v = 0; v < 3; ++v) {
      SceneData other = data;
      other.vertices[v].*axis = -33554433;
      const Result<Scene> scene = make_scene(other);
      EXPECT_EQ(code_of(scene), ErrorCode::kOutOfRange);
      EXPECT_EQ(scene.error().index, static_cast<std::int64_t>(v));
      EXPECT_EQ(scene.error().message,
                "vertex " + std::to_string(v) +
                    " has the coordinate -33554433, which is not in 26 bits");
    }
  }
}

TEST(MakeScene, RefusesCornersThatNameNoVertex) {
  for (const VertexId vertex : {-1, 3, 1000}) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      SceneData data = one_polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
      data.corners[corner] = vertex;
      const Result<Scene> scene = make_scene(data);
      EXPECT_EQ(code_of(scene), ErrorCode::kBadIndex);
      EXPECT_EQ(scene.error().index, 0);
      EXPECT_EQ(scene.error().message,
                "polygon 0 names vertex " + std::to_string(vertex) + " of 3");
    }
  }
}

TEST(MakeScene, LetsOnlyTrianglesHaveCornersOfDifferentColours) {
  // A triangle, a square, and a square that shares corners with it.
  SceneData data = one_polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  data.corners = {0, 1, 2, 0, 1, 2, 3, 3, 2, 1, 0};
  data.first_corner = {0, 3, 7, 11};
  data.colors.resize(3);
  EXPECT_TRUE(make_scene(data));
  data.corner_colors.resize(11);
  for (std::uint8_t i = 0; i < 3; ++i) data.corner_colors[i] = {i, 0, 0};
  for (std::size_t i = 3; i < 7; ++i) data.corner_colors[i] = {7, 7, 7};
  EXPECT_TRUE(make_scene(data));
  for (std::size_t corner = 3; corner < 11; ++corner) {
    SceneData other = data;
    ++other.corner_colors[corner].g;
    const Result<Scene> scene = make_scene(other);
    const std::int64_t polygon = corner < 7 ? 1 : 2;
    EXPECT_EQ(code_of(scene), ErrorCode::kNotTriangle);
    EXPECT_EQ(scene.error().index, polygon);
    EXPECT_EQ(scene.error().message,
              "polygon " + std::to_string(polygon) +
                  " has differing vertex colours and 4 vertices, not 3");
  }
}

TEST(GridBitsFor, IsTheLeastGridThatHoldsEveryCoordinate) {
  EXPECT_EQ(grid_bits_for({}), 26);
  for (std::int64_t GridPoint::*const axis :
       {&GridPoint::x, &GridPoint::y, &GridPoint::z}) {
    const auto bits_of = [axis](std::int64_t coordinate) {
      std::vector<GridPoint> points(3, {1, -1, 1});
      points[1].*axis = coordinate;
      return grid_bits_for(points);
    };
    for (const auto& [bits, next] : {std::pair(26, 40), {40, 54}, {54, 0}}) {
      const std::int64_t limit = std::int64_t{1} << (bits - 1);
      EXPECT_EQ(bits_of(limit - 1), bits);
      EXPECT_EQ(bits_of(-limit), bits);
      EXPECT_EQ(bits_of(limit), next);
      EXPECT_EQ(bits_of(-limit - 1), next);
    }
  }
}

}  // namespace
}  // namespace halfspace
