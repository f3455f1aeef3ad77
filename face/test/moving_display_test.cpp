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
  view.anti_aliasing = AntiAliasing::kExactArea;
  view.back_color = Rgb{1, 2, 3};
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kOutOfRange);
  view.back_color.reset();
  view.alpha = 9;
  EXPECT_EQ(display.render(view).error().code, ErrorCode::kOutOfRange);
}

Mesh block() { return mesh_of(Solid::box({-1, -1, -1}, {1, 1, 1})); }

/// A block that stands where both grids hold it, and the same in one display.
struct Standing {
  MovingDisplay moving = *MovingDisplay::of(floor_mesh());
  std::int32_t block_there = 0;
  Display still = *Display::of(std::array<Solid, 2>{
      Solid::box({-8, -8, -1}, {8, 8, 0}),
      Solid::box({-1, -1, -1}, {1, 1, 1}).transformed(moved(-3.5, 0.5, 2))});

  Standing() {
    const std::int32_t model = *moving.add_model(block());
    block_there = *moving.insert(model, kLeftBox);
    EXPECT_TRUE(moving.place(block_there, moved(-3.5, 0.5, 2)));
  }
};

TEST(MovingDisplay, LooksAreThoseOfAllInOneDisplay) {
  const Standing both;
  std::vector<View> views(9, of_the_floor());
  views[1].anti_aliasing = AntiAliasing::k2;
  views[2].alpha = 100;
  views[3].alpha = 200;
  views[3].anti_aliasing = AntiAliasing::k4;
  views[4].clips = {{{1, 0, 0}, -3.25}};
  views[4].back_color = Rgb{255, 0, 9};
  views[5] = views[4];
  views[5].anti_aliasing = AntiAliasing::k2;
  views[6].anti_aliasing = AntiAliasing::kExactArea;
  views[7].clips = {{{1, 0, 0}, -3.25}, {{0, 0, -1}, -2.5}};
  views[7].caps = CapStyle{{9, 200, 30}, Rgb{0, 0, 0}};
  views[8] = views[7];
  views[8].caps_by_solid = true;
  std::vector<ColorImage> seen;
  for (View& view : views) {
    view.threads = 1;
    const auto picture = both.moving.render(view);
    ASSERT_TRUE(picture.has_value());
    const ColorImage expected = both.still.render(view)->colors;
    std::size_t differ = 0;
    for (std::size_t k = 0; k < expected.pixels.size(); ++k)
      differ += picture->colors.pixels[k] != expected.pixels[k];
    // Cameras are rounded to the grids of both, and areas show it.
    EXPECT_LE(differ, view.anti_aliasing == AntiAliasing::kExactArea ? 2u : 0u);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), picture->colors), 0);
    seen.push_back(picture->colors);
  }
}

TEST(MovingDisplay, CapsSayWhoseTheyAre) {
  const Standing both;
  View view = of_the_floor();
  view.clips = {{{0, 0, -1}, -2}, {{-1, 0, 0}, 3}};
  view.eye = Point{9, -4, 12};
  view.caps = CapStyle{{9, 200, 30}, {}};
  const MovingPicture plain = *both.moving.render(view);
  view.caps_by_solid = true;
  const MovingPicture told = *both.moving.render(view);
  std::size_t top = 0, side = 0, of_floor = 0;
  for (std::size_t k = 0; k < told.polygons.pixels.size(); ++k) {
    const std::int32_t polygon = told.polygons.pixels[k];
    EXPECT_EQ(polygon, plain.polygons.pixels[k]);
    if (polygon > kFirstCap) continue;
    EXPECT_EQ(plain.objects.pixels[k], kBackground);
    top += polygon == kFirstCap && told.objects.pixels[k] == both.block_there;
    side +=
        polygon == kFirstCap - 1 && told.objects.pixels[k] == both.block_there;
    of_floor += polygon == kFirstCap - 1 && told.objects.pixels[k] == 0;
  }
  EXPECT_GT(top, 20u);
  EXPECT_GT(side, 10u);
  EXPECT_GT(of_floor, 100u);
  // Nothing is filled that is not closed.
  MovingDisplay open = *MovingDisplay::of(floor_mesh());
  Mesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.add({0, 1, 2});
  ASSERT_TRUE(open.add_model(sheet));
  EXPECT_EQ(open.render(view).error().code, ErrorCode::kOpen);
  view.caps.reset();
  EXPECT_TRUE(open.render(view));
}

}  // namespace
}  // namespace halfspace
