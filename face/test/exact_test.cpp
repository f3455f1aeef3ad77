#include "halfspace/exact.hpp"

#include <gtest/gtest.h>

#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/halfspace.hpp"

namespace halfspace {
namespace {

TEST(FaceExact, ASolidIsThereInFull) {
  const Solid part =
      Solid::box({0, 0, 0}, {2, 2, 2}) - Solid::box({1, 1, 1}, {3, 3, 3});
  const exact::Solid solid = *exact::solid_of(part);
  EXPECT_EQ(solid.faces.size(), 9u);
  EXPECT_TRUE(exact::bad_edges(solid).empty());
  // From there on under the names that the reference has, too.
  const exact::Solid corner = exact::boolean(
      BooleanOp::kDifference, exact::to_solid(GridSolid(), solid), solid);
  EXPECT_TRUE(corner.faces.empty());
  EXPECT_EQ(exact::solid_of(~part).error().code, ErrorCode::kUnbounded);
  // An empty solid without a table is an operand like any other.
  EXPECT_EQ(
      exact::boolean(BooleanOp::kUnion, solid, exact::Solid{}).faces.size(),
      9u);
}

TEST(FaceExact, NoThreadsAreAllThreadsOfTheMachine) {
  const exact::Solid a = *exact::solid_of(Solid::sphere(3, 40));
  const exact::Solid half =
      exact::half_space({{{0, 0, 0}, {1000, 0, 7}, {0, 1000, 3}}}, a);
  const auto mesh_by = [&](int threads) {
    return exact::to_mesh(
        exact::boolean(BooleanOp::kIntersection, a, half, threads),
        {.threads = threads});
  };
  const auto one = mesh_by(1), all = mesh_by(0);
  EXPECT_EQ(one.vertices, all.vertices);
  EXPECT_EQ(one.corners, all.corners);
  EXPECT_TRUE(fast::check_operand(a, {.threads = 0}));
  const auto display = Display::of(Solid::sphere(3, 12));
  const Camera camera = *display->camera({.width_px = 64, .height_px = 48});
  const auto tree = fast::build_display_tree(display->scene());
  const auto image_by = [&](int threads) {
    exact::RenderOptions how;
    how.threads = threads;
    return exact::render(display->scene(), tree, camera, {}, how).items;
  };
  EXPECT_EQ(image_by(0), image_by(1));
}

}  // namespace
}  // namespace halfspace
