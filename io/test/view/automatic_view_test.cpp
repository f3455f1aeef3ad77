#include <gtest/gtest.h>

#include <cmath>

#include "view/views.hpp"

namespace halfspace::io {
namespace {

using glm::dvec3;
using samples::box_scene;
using samples::image_of;

TEST(AutomaticView, JustHoldsTheScene) {
  const struct {
    Unit unit;
    std::int64_t size;
    int bits;
    GridPoint at;
  } cases[] = {{{10, -3}, 1000, 26, {0, 0, 0}},
               {{2, 0}, 33554431, 26, {0, 0, 0}},
               {{2, -30}, 1LL << 40, 54, {-(1LL << 52), 0, 1LL << 52}},
               {{10, 20}, 3, 26, {5, 5, 5}},
               {{2, -50}, 1 << 20, 26, {1, 2, 3}}};
  for (const auto& [unit, size, bits, at] : cases) {
    const Scene scene = box_scene(unit, size, bits, at);
    for (const auto& [width, height] : {std::pair{640, 480}, {100, 400}}) {
      const Result<Viewed> view = automatic_view(scene, width, height);
      ASSERT_TRUE(view) << view.error().message;
      double widest = 0;
      for (const GridPoint& p : scene.data().vertices) {
        const dvec3 point = dvec3{p.x, p.y, p.z} * 256.0;
        const dvec3 image = image_of(view->camera.data(), point);
        EXPECT_GT(image.z, 0);
        widest = std::max({widest, std::abs(2 * image.x / width - 1),
                           std::abs(2 * image.y / height - 1)});
      }
      EXPECT_LE(widest, 1.001);
      EXPECT_GE(widest, 0.9);
    }
  }
  EXPECT_EQ(automatic_view(Scene{}, 64, 48).error().code, ErrorCode::kEmpty);
}

TEST(AutomaticView, LooksFromAboveAtTheMiddle) {
  SceneData data;
  data.unit = {10, -1};
  // The last is no corner.
  data.vertices = {
      {-10, 4, 15}, {30, 9, 7}, {5, 24, 9}, {10, 5, 13}, {9000, -9000, 9000}};
  data.first_corner = {0, 3, 6};
  data.corners = {0, 1, 2, 3, 0, 2};
  data.colors = {{}, {}};
  const Result<Scene> scene = make_scene(data);
  ASSERT_TRUE(scene) << scene.error().message;
  for (const auto& [width, height] : {std::pair{640, 480}, {50, 700}}) {
    const Result<Viewed> view = automatic_view(*scene, width, height);
    ASSERT_TRUE(view) << view.error().message;
    const ViewOptions& options = view->options;
    // As deep in the view as the middle of the box.
    EXPECT_LT(std::abs(glm::dot(options.target - dvec3{1, 1.4, 1.1},
                                glm::normalize(dvec3{0.45, -0.78, 0.42}))),
              1e-12);
    EXPECT_LT(glm::length(middle_of(*scene) - dvec3{1, 1.4, 1.1}), 1e-12);
    EXPECT_EQ(options.up, (dvec3{0, 0, 1}));
    EXPECT_EQ(options.fov_deg, 30);
    EXPECT_EQ(options.width_px, width);
    EXPECT_EQ(options.height_px, height);
    const dvec3 to_eye = glm::normalize(options.eye - options.target);
    const dvec3 wanted = glm::normalize(dvec3{0.45, -0.78, 0.42});
    EXPECT_LT(glm::length(to_eye - wanted), 1e-12);
    // A margin of 4 in a hundred around what is farthest out.
    const dvec3 right = glm::normalize(dvec3{0.78, 0.45, 0});
    const dvec3 above = glm::cross(to_eye, right);
    const double tan_y = std::tan(std::acos(-1) / 12);
    const double tan_x = tan_y * width / height;
    double widest = 0;
    dvec3 least(9), most(-9);
    for (std::size_t v = 0; v < 4; ++v) {
      const GridPoint& p = data.vertices[v];
      const dvec3 from_eye = dvec3{p.x, p.y, p.z} * 0.1 - options.eye;
      const double depth = -glm::dot(from_eye, to_eye);
      const dvec3 seen = {glm::dot(from_eye, right) / depth,
                          glm::dot(from_eye, above) / depth, 0};
      least = glm::min(least, seen);
      most = glm::max(most, seen);
      widest = std::max(
          {widest, std::abs(glm::dot(from_eye, right)) / (depth * tan_x),
           std::abs(glm::dot(from_eye, above)) / (depth * tan_y)});
    }
    EXPECT_NEAR(widest, 1 / 1.04, 1e-9);
    EXPECT_NEAR(least.x, -most.x, 1e-9);
    EXPECT_NEAR(least.y, -most.y, 1e-9);
  }
  const Result<Viewed> none = automatic_view(Scene{}, 64, 48);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "the scene has no polygons to look at");
}

TEST(AutomaticView, FitsInParallelRays) {
  const Scene scene = box_scene({10, 0}, 6, 26, {10, 20, 30});
  const ViewDirection front = {{0, -1, 0}, {0, 0, 1}};
  for (const auto& [width, height] : {std::pair{600, 300}, {100, 400}}) {
    const auto options = automatic_options(scene, front, width, height, true);
    ASSERT_TRUE(options) << options.error().message;
    EXPECT_TRUE(options->orthographic);
    EXPECT_LT(glm::length(options->target - middle_of(scene)), 1e-12);
    const auto box = middle_of(scene);
    EXPECT_NEAR(options->eye.x, box.x, 1e-12);
    EXPECT_LT(options->eye.y, box.y);
    EXPECT_GT(options->ortho_height, 0);
    EXPECT_TRUE(look_at(scene, *options));
  }
  const ViewDirection along = {{0, 0, 1}, {0, 0, 2}};
  EXPECT_EQ(automatic_options(scene, along, 9, 9).error().code,
            ErrorCode::kBadCamera);
}

TEST(AutomaticView, TurnsWithUp) {
  const auto is_near = [](const dvec3& a, const dvec3& b) {
    return glm::length(a - b) < 1e-12;
  };
  const ViewDirection front = {{0, -1, 0}, {0, 0, 1}};
  const ViewDirection as_it_is = turned(front, {0, 0, 3});
  EXPECT_TRUE(is_near(as_it_is.to_eye, {0, -1, 0}));
  // With y upwards the front is where z points.
  const ViewDirection y_up = turned(front, {0, 2, 0});
  EXPECT_TRUE(is_near(y_up.to_eye, {0, 0, 1}));
  EXPECT_TRUE(is_near(y_up.up, {0, 1, 0}));
  const ViewDirection x_up = turned(front, {1, 0, 0});
  EXPECT_TRUE(is_near(x_up.to_eye, {0, -1, 0}));
  EXPECT_TRUE(is_near(x_up.up, {1, 0, 0}));
  const ViewDirection down = turned(front, {0, 0, -1});
  EXPECT_TRUE(is_near(down.to_eye, {0, 1, 0}));
  EXPECT_TRUE(is_near(down.up, {0, 0, -1}));
}

}  // namespace
}  // namespace halfspace::io
