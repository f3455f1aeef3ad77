#include "core/moves.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/measure.hpp"

namespace halfspace::viewer {
namespace {

using glm::dvec2;
using glm::dvec3;

io::ViewOptions camera() {
  io::ViewOptions camera;
  camera.eye = {3, -4, 5};
  camera.target = {1, 0, 2};
  camera.width_px = 800;
  camera.height_px = 600;
  return camera;
}

double distance(const io::ViewOptions& c) {
  return glm::distance(c.eye, c.target);
}

TEST(Moves, TurningKeepsTheDistanceAndTheTarget) {
  for (const dvec2 drag : {dvec2(10, 0), dvec2(0, 10), dvec2(-700, 900)}) {
    for (const auto& turned :
         {orbited(camera(), drag), rolled(camera(), drag)}) {
      EXPECT_NEAR(distance(turned), distance(camera()), 1e-12);
      EXPECT_EQ(turned.target, camera().target);
    }
  }
}

TEST(Moves, TheTurntableKeepsTheHorizonLevel) {
  io::ViewOptions c = camera();
  for (int i = 0; i < 50; ++i) c = orbited(c, {37, i % 3 - 1.0});
  EXPECT_NEAR(axes_of(c).right.z, 0, 1e-12);
}

TEST(Moves, TheTurntableStopsAtThePole) {
  io::ViewOptions c = orbited(camera(), {0, 5000});
  EXPECT_NEAR(axes_of(c).back.z, 1, 1e-12);
  c = orbited(c, {100, 0});
  EXPECT_NEAR(glm::length(axes_of(c).right), 1, 1e-12);
  c = orbited(c, {0, -600});
  EXPECT_NEAR(axes_of(c).back.z, -1, 1e-12);
}

TEST(Moves, ADragToTheRightTurnsTheModelToTheRight) {
  const dvec3 near_point = camera().target + axes_of(camera()).back;
  const auto before = projected(camera(), near_point);
  for (const auto& turned :
       {orbited(camera(), {20, 0}), rolled(camera(), {20, 0})})
    EXPECT_GT(projected(turned, near_point)->x, before->x + 1);
  for (const auto& turned :
       {orbited(camera(), {0, 20}), rolled(camera(), {0, 20})})
    EXPECT_GT(projected(turned, near_point)->y, before->y + 1);
}

TEST(Moves, PanningKeepsThePointUnderTheCursor) {
  const auto before = projected(camera(), camera().target);
  const auto after = projected(panned(camera(), {31, -17}), camera().target);
  EXPECT_NEAR(after->x - before->x, 31, 1e-9);
  EXPECT_NEAR(after->y - before->y, -17, 1e-9);
}

TEST(Moves, ZoomKeepsThePointUnderTheCursor) {
  for (const bool orthographic : {false, true}) {
    const io::ViewOptions from = with_projection(camera(), orthographic);
    const dvec2 cursor(620, 133);
    const dvec2 off = cursor - dvec2(400, 300);
    const CameraAxes axes = axes_of(from);
    const dvec3 point =
        from.target +
        height_at_target(from) / 600 * (off.x * axes.right - off.y * axes.up);
    const io::ViewOptions to = zoomed(from, 0.5, cursor);
    EXPECT_NEAR(projected(to, point)->x, cursor.x, 1e-9);
    EXPECT_NEAR(projected(to, point)->y, cursor.y, 1e-9);
    EXPECT_NEAR(height_at_target(to), height_at_target(from) / 2, 1e-12);
  }
}

TEST(Moves, AtTheTargetEveryProjectionSeesTheSame) {
  const io::ViewOptions parallel = with_projection(camera(), true);
  EXPECT_NEAR(height_at_target(parallel), height_at_target(camera()), 1e-12);
  const io::ViewOptions back = with_projection(parallel, false);
  EXPECT_NEAR(glm::distance(back.eye, camera().eye), 0, 1e-12);
  const io::ViewOptions wide = with_field(camera(), 90);
  EXPECT_NEAR(height_at_target(wide), height_at_target(camera()), 1e-12);
}

TEST(Moves, AFlightBeginsAndEndsWhereItIsTold) {
  const io::ViewOptions to = orbited(zoomed(camera(), 3, {1, 2}), {500, 90});
  const io::ViewOptions first = between(camera(), to, 0);
  EXPECT_NEAR(glm::distance(first.eye, camera().eye), 0, 1e-12);
  EXPECT_TRUE(is_same(between(camera(), to, 1), to));
  const double half = distance(between(camera(), to, 0.5));
  EXPECT_NEAR(half, std::sqrt(distance(camera()) * distance(to)), 1e-9);
}

}  // namespace
}  // namespace halfspace::viewer
