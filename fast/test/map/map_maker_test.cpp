#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>

#include "halfspace/fast/image/transparent_map.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/splitmix.hpp"

/// Maps that are too large: the error says the cells that there would be.
namespace halfspace::fast {
namespace {

Scene many_triangles() {
  SceneData data;
  for (std::uint64_t t = 0; t < 60; ++t) {
    for (std::uint64_t k = 0; k < 3; ++k) {
      const auto at = [&](std::uint64_t axis) {
        return static_cast<std::int64_t>(mix(9 * t + 3 * k + axis) % 4096);
      };
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
      data.vertices.push_back({at(0), at(1), at(2)});
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({static_cast<std::uint8_t>(4 * t), 0, 0});
  }
  Result<Scene> scene = make_scene(std::move(data));
  EXPECT_TRUE(scene.has_value());
  return std::move(*scene);
}

Camera from_above(const Scene& scene) {
  CameraData data;
  data.perspective = false;
  data.eye = {0, 0, 256};
  data.sx = {256 * 64, 0, 0};
  data.sy = {0, 256 * 64, 0};
  data.width_px = data.height_px = 64;
  return *make_camera(data, scene.grid_bits());
}

/// The number before " cells" in a message.
std::size_t cells_in(const std::string& message) {
  const std::size_t end = message.find(" cells");
  const std::size_t start = message.rfind(' ', end - 1) + 1;
  return std::stoul(message.substr(start, end - start));
}

template <class MakeMap>
void expect_counts(const MakeMap& make_map) {
  const Result<VisibleMap> whole = make_map(MapLimits());
  ASSERT_TRUE(whole.has_value());
  ASSERT_GT(whole->cells, 200u);
  const Result<VisibleMap> none = make_map(MapLimits{3});
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().message, "the visible map needs " +
                                      std::to_string(whole->cells) +
                                      " cells, and the limit is 3");
  EXPECT_TRUE(make_map(MapLimits{whole->cells}).has_value());
  EXPECT_FALSE(make_map(MapLimits{whole->cells - 1}).has_value());
  // In parts, which cut some cells.
  const Result<VisibleMap> parts = make_map(MapLimits{3, whole->cells * 2 / 3});
  ASSERT_FALSE(parts.has_value());
  EXPECT_NE(parts.error().message.find(" about "), std::string::npos);
  EXPECT_GE(2 * cells_in(parts.error().message), whole->cells);
  EXPECT_LE(cells_in(parts.error().message), 2 * whole->cells);
  const Result<VisibleMap> many = make_map(MapLimits{3, whole->cells / 10});
  ASSERT_FALSE(many.has_value());
  EXPECT_NE(
      many.error().message.find(
          "more than " + std::to_string(whole->cells / 10 * 4) + " cells"),
      std::string::npos)
      << many.error().message;
}

TEST(MapMaker, TheErrorSaysHowManyCellsThereWouldBe) {
  const Scene scene = many_triangles();
  const Camera camera = from_above(scene);
  const BspTree tree = build(scene, {});
  expect_counts([&](const MapLimits& limits) {
    return visible_map(scene, tree, camera, {}, limits);
  });
  expect_counts([&](const MapLimits& limits) {
    return transparent_map(scene, tree, camera, {false, 100}, limits);
  });
}

}  // namespace
}  // namespace halfspace::fast
