#include "halfspace/moving_display.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "halfspace/display.hpp"
#include "halfspace/solid.hpp"

namespace halfspace {
namespace {

Mesh mesh_of(const Solid& solid) {
  Mesh mesh = *solid.mesh();
  mesh.colors.clear();
  return mesh;
}

Mesh floor_mesh() { return mesh_of(Solid::box({-8, -8, -1}, {8, 8, 0})); }
Mesh ball() { return mesh_of(Solid::sphere(1, 16)); }

AffineMap moved(double x, double y, double z) {
  return {{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}}};
}

View of_the_floor() {
  View view;
  view.width_px = 80;
  view.height_px = 60;
  view.eye = Point{9, -14, 12};
  view.target = Point{0, 0, 1};
  return view;
}

std::size_t seen(const ItemImage& items, std::int32_t id) {
  return static_cast<std::size_t>(
      std::count(items.pixels.begin(), items.pixels.end(), id));
}

constexpr std::array<Point, 2> kLeftBox = {Point{-6, -3, 0.5}, Point{-1, 3, 4}};
/// A tent over the right half.
constexpr std::array<Point, 6> kTent = {Point{0, -3, 0.25}, Point{7, -3, 0.25},
                                        Point{0, 3, 0.25},  Point{7, 3, 0.25},
                                        Point{3.5, -3, 6},  Point{3.5, 3, 6}};

TEST(MovingDisplay, AnObjectLooksLikeItsMeshMoved) {
  MovingDisplay display = *MovingDisplay::of(floor_mesh());
  const std::int32_t model = *display.add_model(ball());
  const std::int32_t left = *display.insert(model, kLeftBox);
  const std::int32_t right = *display.insert(model, kTent);
  for (const double step : {0.0, 0.25, 0.5}) {
    ASSERT_TRUE(display.place(left, moved(-3.5 + step, 0, 2)));
    ASSERT_TRUE(display.place(right, moved(3.5 - step, step, 1.5)));
    const MovingPicture picture = *display.render(of_the_floor());
    const std::vector<Solid> all = {
        Solid::box({-8, -8, -1}, {8, 8, 0}),
        Solid::sphere(1, 16).transformed(moved(-3.5 + step, 0, 2)),
        Solid::sphere(1, 16).transformed(moved(3.5 - step, step, 1.5))};
    const Display still = *Display::of(all);
    const Picture expected = *still.render(of_the_floor());
    std::array<std::size_t, 3> differ{};
    for (std::size_t i = 0; i < expected.polygons.pixels.size(); ++i) {
      const std::int32_t polygon = expected.polygons.pixels[i];
      const std::int32_t object = picture.objects.pixels[i];
      if (polygon == kBackground) {
        differ[0] += object != kBackground ? 1u : 0u;
        continue;
      }
      const std::int32_t solid =
          still
              .pick(of_the_floor(), static_cast<std::int32_t>(i % 80),
                    static_cast<std::int32_t>(i / 80))
              ->value()
              .solid;
      differ[1] += object != solid ? 1u : 0u;
    }
    // Corners of a ball are rounded to the grids of both.
    EXPECT_LE(differ[0] + differ[1], 2u);
    EXPECT_GT(seen(picture.objects, left), 20u);
    EXPECT_GT(seen(picture.objects, right), 20u);
    EXPECT_GT(seen(picture.objects, 0), 500u);
  }
}

TEST(MovingDisplay, ObjectsComeAndGo) {
  MovingDisplay display = *MovingDisplay::of(floor_mesh());
  const MovingPicture empty = *display.render(of_the_floor());
  const std::int32_t model = *display.add_model(ball());
  const std::int32_t first = *display.insert(model, kLeftBox);
  ASSERT_TRUE(display.place(first, moved(-3.5, 0, 2)));
  const MovingPicture one = *display.render(of_the_floor());
  EXPECT_GT(seen(one.objects, first), 20u);
  // Its region is taken while it is there, if hidden.
  ASSERT_TRUE(display.hide(first));
  EXPECT_EQ(display.render(of_the_floor())->colors, empty.colors);
  EXPECT_EQ(display.insert(model, kLeftBox).error().code,
            ErrorCode::kOutOfRange);
  ASSERT_TRUE(display.remove(first));
  EXPECT_EQ(display.remove(first).error().code, ErrorCode::kBadIndex);
  EXPECT_EQ(display.place(first, moved(0, 0, 0)).error().code,
            ErrorCode::kBadIndex);
  const std::int32_t second = *display.insert(model, kLeftBox);
  EXPECT_NE(second, first);
  ASSERT_TRUE(display.place(second, moved(-3.5, 0, 2)));
  const MovingPicture again = *display.render(of_the_floor());
  EXPECT_EQ(again.colors, one.colors);
  EXPECT_EQ(seen(again.objects, first), 0u);
  EXPECT_EQ(seen(again.objects, second), seen(one.objects, first));
}

TEST(MovingDisplay, WhatDoesNotStayInItsRegionIsAnErrorThatNamesIt) {
  MovingDisplay display = *MovingDisplay::of(floor_mesh());
  const std::int32_t model = *display.add_model(ball());
  const std::int32_t tent = *display.insert(model, kTent);
  ASSERT_TRUE(display.place(tent, moved(3.5, 0, 5)));  // under no roof there
  const auto leaves = display.render(of_the_floor());
  ASSERT_FALSE(leaves);
  EXPECT_EQ(leaves.error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(leaves.error().index, tent);
  ASSERT_TRUE(
      display.place(tent, {{{1, 0, 0, 3}, {1, 0, 0, 0}, {0, 0, 1, 2}}}));
  EXPECT_EQ(display.render(of_the_floor()).error().code, ErrorCode::kZeroArea);
  ASSERT_TRUE(display.place(tent, moved(3.5, 0, 1.5)));
  EXPECT_TRUE(display.render(of_the_floor()));
  // A region that the floor reaches into.
  const std::array<Point, 2> low = {Point{-6, -3, -0.5}, Point{-1, 3, 4}};
  const std::int32_t bad = *display.insert(model, low);
  EXPECT_EQ(display.render(of_the_floor()).error().code,
            ErrorCode::kOutOfRange);
  ASSERT_TRUE(display.remove(bad));
  EXPECT_TRUE(display.render(of_the_floor()));
}

TEST(MovingDisplay, RegionsAndModelsAreChecked) {
  MovingDisplay display = *MovingDisplay::of(floor_mesh());
  const std::int32_t model = *display.add_model(ball());
  EXPECT_EQ(display.insert(0, kLeftBox).error().code, ErrorCode::kBadIndex);
  EXPECT_EQ(display.insert(model + 1, kLeftBox).error().code,
            ErrorCode::kBadIndex);
  EXPECT_EQ(display.insert(model, kLeftBox, model).error().code,
            ErrorCode::kBadIndex);
  const std::array<Point, 4> flat = {Point{0, 0, 1}, Point{1, 0, 1},
                                     Point{0, 1, 1}, Point{1, 1, 1}};
  EXPECT_EQ(display.insert(model, flat).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(display.insert(model, std::span(flat).first(3)).error().code,
            ErrorCode::kOutOfRange);
  View view = of_the_floor();
  view.back_color = Rgb{1, 2, 3};
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kOutOfRange);
  view.back_color.reset();
  view.alpha = 9;
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kOutOfRange);
  view.alpha = kOpaque;
  view.anti_aliasing = AntiAliasing::k2;
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kOutOfRange);
}

}  // namespace
}  // namespace halfspace
