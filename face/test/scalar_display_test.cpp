#include <gtest/gtest.h>

#include <cmath>

#include "halfspace/halfspace.hpp"
#include "halfspace/visible_map.hpp"

namespace halfspace {
namespace {

/// A square of two units in the plane z = 0 with the x of its corners as field.
Mesh square(double left = -1, double right = 1) {
  Mesh mesh;
  mesh.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.add({0, 1, 2, 3});
  mesh.fields = {left, right, right, left};
  mesh.field_count = 1;
  return mesh;
}

/// From above, a pixel a quarter of a unit.
View from_above() {
  View view;
  view.eye = {0, 0, 10};
  view.target = {0, 0, 0};
  view.orthographic = true;
  view.ortho_height = 2;
  view.width_px = 8;
  view.height_px = 8;
  return view;
}

TEST(ScalarDisplay, BandsEndWhereTheNumberPassesASteps) {
  const auto display = ScalarDisplay::of(square());
  ASSERT_TRUE(display.has_value());
  ScalarStyle style;
  style.map = "grey";
  style.steps = 4;
  const auto picture = display->render(from_above(), style);
  ASSERT_TRUE(picture.has_value());
  for (std::int32_t j = 0; j < 8; ++j) {
    for (std::int32_t i = 0; i < 8; ++i) {
      EXPECT_EQ(picture->polygons.at(i, j), 0);
      EXPECT_EQ(picture->colors.at(i, j), picture->colors.at(i / 2 * 2, 0));
      if (i >= 2) {
        EXPECT_EQ(picture->colors.at(i, j).r > picture->colors.at(i - 2, j).r,
                  true);
      }
    }
  }
}

TEST(ScalarDisplay, NumbersMayBeTransparent) {
  const auto display = ScalarDisplay::of(square());
  ScalarStyle style;
  style.map = "grey";
  style.steps = 4;
  View view = from_above();
  view.background = {10, 20, 250};
  const Picture opaque = *display->render(view, style);
  view.alpha = 77;
  const Picture glass = *display->render(view, style);
  EXPECT_EQ(glass.polygons, opaque.polygons);
  for (std::size_t k = 0; k < glass.colors.pixels.size(); ++k) {
    EXPECT_EQ(glass.colors.pixels[k],
              composed_color(opaque.colors.pixels[k], view.background, 77));
  }
  // Bands end between pixels, and all samples of one are alike.
  view.anti_aliasing = AntiAliasing::k2;
  EXPECT_EQ(display->render(view, style)->colors, glass.colors);
}

TEST(ScalarDisplay, MissingNumbersHaveTheirOwnColour) {
  const auto display = ScalarDisplay::of(square(std::nan(""), 1));
  ASSERT_TRUE(display.has_value());
  ScalarStyle style;
  style.low = 0;
  style.high = 1;
  style.no_data = {255, 0, 255};
  const auto picture = display->render(from_above(), style);
  ASSERT_TRUE(picture.has_value());
  for (const Rgb& color : picture->colors.pixels) EXPECT_EQ(color.g, 0);
}

TEST(ScalarDisplay, FieldsComeOutOfBooleans) {
  Mesh hot = *Solid::box({0, 0, 0}, {2, 2, 2}).mesh();
  for (const std::int32_t vertex : hot.corners)
    hot.fields.push_back(hot.vertices[static_cast<std::size_t>(vertex)].z);
  hot.field_count = 1;
  const auto cut =
      (Solid::from_mesh(hot) - Solid::box({1, 1, 1}, {3, 3, 3})).mesh();
  ASSERT_TRUE(cut.has_value());
  ASSERT_EQ(cut->field_count, 1u);
  const auto display = ScalarDisplay::of(*cut);
  ASSERT_TRUE(display.has_value());
  EXPECT_TRUE(display->render().has_value());
}

TEST(ScalarDisplay, BadInputIsAnError) {
  EXPECT_EQ(ScalarDisplay::of(square(), 1).error().code, ErrorCode::kBadIndex);
  EXPECT_EQ(ScalarDisplay::of(square(HUGE_VAL)).error().code,
            ErrorCode::kNotFinite);
  const auto display = ScalarDisplay::of(square());
  ScalarStyle style;
  style.map = "sunny";
  EXPECT_EQ(display->render({}, style).error().code, ErrorCode::kUnknownFormat);
  style = {};
  style.logarithmic = true;
  style.low = -1;
  EXPECT_EQ(display->render({}, style).error().code, ErrorCode::kOutOfRange);
  View areas;
  areas.back_color = Rgb{1, 2, 3};
  EXPECT_EQ(display->render(areas).error().code, ErrorCode::kOutOfRange);
  areas.back_color.reset();
  areas.caps_by_solid = true;
  EXPECT_EQ(display->render(areas).error().code, ErrorCode::kOutOfRange);
  areas.caps_by_solid = false;
  areas.anti_aliasing = AntiAliasing::kExactArea;
  EXPECT_EQ(display->render(areas).error().code, ErrorCode::kOutOfRange);
  const auto empty = ScalarDisplay::of(square(std::nan(""), std::nan("")));
  EXPECT_EQ(empty->render().error().code, ErrorCode::kEmpty);
}

}  // namespace
}  // namespace halfspace
