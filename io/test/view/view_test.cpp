#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "view/views.hpp"

namespace halfspace::io {
namespace {

using glm::dvec3;
using samples::box_scene;
using samples::corners_of;
using samples::image_of;

Viewed viewed(const Scene& scene, const ViewOptions& options) {
  const Result<Viewed> view = look_at(scene, options);
  EXPECT_TRUE(view) << view.error().message;
  return *view;
}

ViewOptions options_at(dvec3 eye, dvec3 target) {
  ViewOptions options;
  options.eye = eye;
  options.target = target;
  options.width_px = 200;
  options.height_px = 100;
  return options;
}

TEST(LookAt, SeesTheTargetInTheMiddleAndUpUpwards) {
  const Scene scene = box_scene({10, -3}, 1000, 26);
  for (const bool orthographic : {false, true}) {
    ViewOptions options = options_at({5, -4, 3}, {0.5, 0.25, 0.125});
    options.orthographic = orthographic;
    const Viewed view = viewed(scene, options);
    const CameraData& camera = view.camera.data();
    const dvec3 target = options.target * 1000.0 * 256.0;
    const dvec3 middle = image_of(camera, target);
    EXPECT_NEAR(middle.x, 100, orthographic ? 0.01 : 1e-4);
    EXPECT_NEAR(middle.y, 50, orthographic ? 0.01 : 1e-4);
    const dvec3 above = image_of(camera, target + dvec3{0, 0, 25600});
    EXPECT_NEAR(above.x, 100, 0.01);
    EXPECT_LT(above.y, 49);
    // Right of the view from the front is where x grows.
    const dvec3 right = image_of(camera, target + dvec3{25600, 0, 0});
    EXPECT_GT(right.x, 101);
    EXPECT_LT(view.max_move, 1);
    EXPECT_GT(above.z, 0);
  }
}

TEST(LookAt, HasTheFieldOfViewThatWasAskedFor) {
  const Scene scene = box_scene({2, 0}, 1000, 26);
  ViewOptions options = options_at({0, -1000, 0}, {0, 0, 0});
  options.fov_deg = 90;
  const dvec3 edge =
      image_of(viewed(scene, options).camera.data(), dvec3{0, 0, 1000} * 256.0);
  EXPECT_NEAR(edge.y, 0, 1e-6);
  options.orthographic = true;
  options.ortho_height = 500;
  const dvec3 top =
      image_of(viewed(scene, options).camera.data(), dvec3{0, 77, 250} * 256.0);
  EXPECT_NEAR(top.y, 0, 1e-6);
  EXPECT_NEAR(top.x, 100, 1e-6);
}

TEST(LookAt, UsesTheRangeOfTheLattice) {
  for (const int bits : kGridBits) {
    const Scene scene = box_scene({2, 0}, 1000, bits);
    const CameraData camera =
        viewed(scene, options_at({3000, -2000, 1500}, {0, 0, 0})).camera.data();
    const double limit = std::ldexp(1, bits + 13);
    double most = 0;
    for (const dvec3& corner : corners_of(camera, 200, 100)) {
      for (int axis = 0; axis < 3; ++axis)
        most = std::max(most, std::abs(corner[axis]));
    }
    EXPECT_LT(most, limit);
    EXPECT_GT(most, 0.99 * limit);
  }
}

TEST(LookAt, PutsTheNearDistanceExactly) {
  const Scene scene = box_scene({10, -3}, 1000, 26);
  for (const bool orthographic : {false, true}) {
    for (const double near : {0.001, 0.5, 1.0, 2.0, 700.0}) {
      ViewOptions options = options_at({0, -5, 0}, {0, 0, 0});
      options.orthographic = orthographic;
      options.near = near;
      const CameraData camera = viewed(scene, options).camera.data();
      ASSERT_TRUE(camera.near);
      // The point at that distance has that parameter.
      const dvec3 point = dvec3{0, -5 + near, 0} * 256000.0;
      const double parameter = image_of(camera, point).z * 65536;
      EXPECT_NEAR(parameter / static_cast<double>(*camera.near), 1, 1e-3)
          << near;
    }
    ViewOptions options = options_at({0, -5, 0}, {0, 0, 0});
    options.orthographic = orthographic;
    EXPECT_FALSE(viewed(scene, options).camera.data().near);
    options.near = 0;
    EXPECT_EQ(viewed(scene, options).camera.data().near, 0);
    options.near = -1;
    const Result<Viewed> behind = look_at(scene, options);
    EXPECT_EQ(behind.has_value(), orthographic);
  }
}

TEST(LookAt, MovesTheEyeByAtMostHalfALatticeStep) {
  const Scene scene = box_scene({2, 0}, 1000, 40);
  const ViewOptions options =
      options_at({1.0 / 3, -1000.0 / 7, 100.1}, {0, 0, 0});
  const Viewed view = viewed(scene, options);
  const dvec3 eye = samples::vector(view.camera.data().eye) / 256.0;
  double moved = 0;
  for (int axis = 0; axis < 3; ++axis) {
    moved = std::max(moved, std::abs(eye[axis] - options.eye[axis]));
  }
  EXPECT_LE(moved, 0.5 / 256);
  EXPECT_GE(view.max_move, moved * 0.999);
}

TEST(LookAt, NamesWhatIsWrong) {
  const Scene scene = box_scene({2, 0}, 1000, 26);
  const ViewOptions good = options_at({0, -5, 0}, {0, 0, 0});
  const auto code_of = [&](auto&& change) {
    ViewOptions options = good;
    change(options);
    const Result<Viewed> view = look_at(scene, options);
    EXPECT_FALSE(view);
    return view ? static_cast<ErrorCode>(-1) : view.error().code;
  };
  using O = ViewOptions;
  EXPECT_EQ(code_of([](O& o) { o.target = o.eye; }), ErrorCode::kBadCamera);
  EXPECT_EQ(code_of([](O& o) { o.up = {0, 1, 0}; }), ErrorCode::kBadCamera);
  EXPECT_EQ(code_of([](O& o) { o.up = {0, 0, 0}; }), ErrorCode::kBadCamera);
  EXPECT_EQ(code_of([](O& o) { o.fov_deg = 180; }), ErrorCode::kBadCamera);
  EXPECT_EQ(code_of([](O& o) { o.fov_deg = 0; }), ErrorCode::kBadCamera);
  EXPECT_EQ(code_of([](O& o) { o.eye.x = std::nan(""); }),
            ErrorCode::kNotFinite);
  EXPECT_EQ(code_of([](O& o) { o.near = INFINITY; }), ErrorCode::kNotFinite);
  EXPECT_EQ(code_of([](O& o) { o.width_px = 0; }), ErrorCode::kOutOfRange);
  EXPECT_EQ(code_of([](O& o) { o.height_px = 65537; }), ErrorCode::kOutOfRange);
  EXPECT_EQ(code_of([](O& o) { o.eye.x = 1e12; }), ErrorCode::kOutOfRange);
  EXPECT_EQ(code_of([](O& o) { o.near = -0.5; }), ErrorCode::kOutOfRange);
  EXPECT_EQ(code_of([](O& o) { o.near = 1e30; }), ErrorCode::kOutOfRange);
  EXPECT_EQ(code_of([](O& o) {
              o.orthographic = true;
              o.near = 1e30;
            }),
            ErrorCode::kOutOfRange);
  for (const double height : {0.0, -1.0}) {
    EXPECT_EQ(code_of([height](O& o) {
                o.orthographic = true;
                o.ortho_height = height;
              }),
              ErrorCode::kBadCamera);
  }
  for (const double height : {1e40, 1e300}) {
    EXPECT_EQ(code_of([height](O& o) {
                o.orthographic = true;
                o.ortho_height = height;
              }),
              ErrorCode::kOutOfRange);
  }
  EXPECT_EQ(code_of([](O& o) {
              o.orthographic = true;
              o.ortho_height = 1e-9;
            }),
            ErrorCode::kBadCamera);
}

TEST(LookAt, AcceptsWhatIsWithinItsLimits) {
  const Scene scene = box_scene({2, 0}, 1000, 26);
  const auto accepted = [&](auto&& change) {
    ViewOptions options = options_at({0, -5, 0}, {0, 0, 0});
    change(options);
    const Result<Viewed> view = look_at(scene, options);
    return view ? std::string() : view.error().message;
  };
  using O = ViewOptions;
  for (const std::int32_t size : {1, 2, 65535, 65536}) {
    EXPECT_EQ(accepted([size](O& o) { o.width_px = size; }), "");
    EXPECT_EQ(accepted([size](O& o) { o.height_px = size; }), "");
  }
  for (const double degrees : {0.5, 1.0, 179.0, 179.5}) {
    EXPECT_EQ(accepted([degrees](O& o) { o.fov_deg = degrees; }), "");
    // It is not looked at in orthographic views, nor is their height in others.
    EXPECT_EQ(accepted([degrees](O& o) {
                o.orthographic = true;
                o.fov_deg = -degrees;
              }),
              "");
    EXPECT_EQ(accepted([degrees](O& o) { o.ortho_height = -degrees; }), "");
  }
  EXPECT_EQ(accepted([](O& o) {
              o.orthographic = true;
              o.ortho_height = 0.5;
            }),
            "");
  const struct {
    void (*change)(O&);
    const char* message;
  } cases[] = {
      {[](O& o) { o.width_px = -3; },
       "an image has 1 to 65536 columns and rows, not -3"},
      {[](O& o) { o.fov_deg = 180; },
       "a field of view is between 0 and 180 degrees, not 180.000000"},
      {[](O& o) { o.fov_deg = 0; },
       "a field of view is between 0 and 180 degrees, not 0.000000"},
      {[](O& o) {
         o.orthographic = true;
         o.ortho_height = 0;
       },
       "the height of an orthographic view is above 0, not 0.000000"},
      {[](O& o) { o.near = -0.5; }, "the near distance is negative"},
      {[](O& o) { o.near = 1e30; }, "the near distance is too far"},
      {[](O& o) { o.target.z = INFINITY; },
       "a number of the view is not finite"},
      {[](O& o) { o.up.y = NAN; }, "a number of the view is not finite"},
      {[](O& o) { o.eye.z = -INFINITY; }, "a number of the view is not finite"},
      {[](O& o) { o.eye = o.target; }, "the eye is at its target"},
      {[](O& o) { o.eye.z = 3e9; },
       "the eye is farther away than cameras of this scene reach, 2.14748e+09 "
       "model units"},
      {[](O& o) { o.fov_deg = 1e-9; },
       "a pixel is less than a step of the camera's lattice: the view is too "
       "narrow for this number of rows"},
      {[](O& o) {
         o.orthographic = true;
         o.ortho_height = 1e40;
       },
       "the image is larger than cameras of this scene reach"},
  };
  for (const auto& [change, message] : cases) {
    EXPECT_EQ(accepted(change), message);
  }
}

TEST(LookAt, KeepsTheImageOnTheLatticeWhereverTheEyeIs) {
  const Scene scene = box_scene({2, 0}, 1000, 26);
  const double limit = std::ldexp(1, 26 + 13);
  for (const dvec3 eye : {dvec3{2e9, 5, 7},
                          {-2e9, 1e9, 3},
                          {4, -2e9, -2e9},
                          {1e9, 1e9, -2.1e9},
                          {0, 3, -2.1e9}}) {
    for (const dvec3 target : {dvec3{0, 0, 0}, eye * 1.01 + dvec3{1, 2, 3},
                               eye + dvec3{5, -3, 2}, eye - dvec3{7, -3, 2}}) {
      for (const double degrees : {5.0, 90.0, 150.0}) {
        ViewOptions options = options_at(eye, target);
        options.fov_deg = degrees;
        options.up = {1, 2, 5};
        const CameraData camera = viewed(scene, options).camera.data();
        // The share of the room between the eye and the near end of each axis.
        double used = 0;
        for (const dvec3& corner : corners_of(camera, 200, 100)) {
          for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(std::abs(corner[axis]), limit);
            const double from = 256 * eye[axis];
            used = std::max(
                used, std::abs(corner[axis] - from) / (limit - std::abs(from)));
          }
        }
        EXPECT_GT(used, 0.95);
        EXPECT_LE(used, 1);
      }
    }
  }
}

TEST(LookAt, TellsHowFarTheCornersOfTheImageMoved) {
  const Scene scene = box_scene({2, 0}, 1000, 26);
  for (const double height : {0.3, 7.7, 400.1}) {
    ViewOptions options = options_at({1.3, -4.1, 2.2}, {0.5, 0.7, 0.9});
    options.orthographic = true;
    options.ortho_height = height;
    const Viewed view = viewed(scene, options);
    const CameraData& camera = view.camera.data();
    const dvec3 forward = glm::normalize(options.target - options.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, options.up));
    const dvec3 down = glm::cross(forward, right);
    const dvec3 x = height * right, y = height / 2 * down;
    const dvec3 wanted[] = {options.eye - x - y, options.eye + x - y,
                            options.eye - x + y, options.eye + x + y};
    const auto got = corners_of(camera, 200, 100);
    double most = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        most = std::max(most, std::abs(got[i][axis] / 256 - wanted[i][axis]));
      }
    }
    EXPECT_GT(most, 0);
    EXPECT_NEAR(view.max_move, most, 1e-9);
  }
}

TEST(LookAt, TellsHowFarTheEyeMovedWhereThatIsMore) {
  const Scene scene = box_scene({2, 0}, 1000, 54);
  ViewOptions options = options_at({0.4 / 256, -1000, 8}, {0.4 / 256, 0, 8});
  options.near = 1;
  options.width_px = options.height_px = 2;
  EXPECT_GE(viewed(scene, options).max_move, 0.399 / 256);
}

TEST(LookAt, HasANegativeNearDistanceInOrthographicViewsOnly) {
  const Scene scene = box_scene({2, 0}, 1000, 26);
  ViewOptions options = options_at({0, -5, 0}, {0, 0, 0});
  options.orthographic = true;
  for (const double near : {-4.0, 4.0}) {
    options.near = near;
    const CameraData camera = viewed(scene, options).camera.data();
    const dvec3 point = dvec3{0, -5 + near, 0} * 256.0;
    EXPECT_NEAR(
        image_of(camera, point).z * 65536 / static_cast<double>(*camera.near),
        1, 1e-6);
    EXPECT_EQ(*camera.near < 0, near < 0);
  }
}

}  // namespace
}  // namespace halfspace::io
