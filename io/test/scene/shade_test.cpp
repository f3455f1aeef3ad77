#include "scene/shade.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "halfspace/io/import.hpp"

namespace halfspace::io {
namespace {

/// The usual surface in the usual light.
Rgb usually_lit(const Direction& normal) {
  return lit(kUsualSurface, normal, ImportOptions());
}

TEST(Shade, NormalsAreTwiceTheArea) {
  // The cross product of (3, -2, 1) and (1, 4, -3) is (2, 10, 14).
  const std::vector<GridPoint> triangle = {
      {7, -11, 5}, {10, -13, 6}, {8, -7, 2}};
  EXPECT_EQ(normal_of(triangle), (Direction{2, 10, 14}));
  const std::vector<GridPoint> turned = {triangle[0], triangle[2], triangle[1]};
  EXPECT_EQ(normal_of(turned), (Direction{-2, -10, -14}));
  // A parallelogram is two such triangles, from wherever it begins.
  std::vector<GridPoint> quad = {
      triangle[0], triangle[1], {11, -9, 3}, triangle[2]};
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(normal_of(quad), (Direction{4, 20, 28}));
    std::rotate(quad.begin(), quad.begin() + 1, quad.end());
  }
}

TEST(Shade, ColoursGoByTheDirectionAlone) {
  EXPECT_EQ(usually_lit({0, 0, 0}), (Rgb{98, 89, 76}));
  EXPECT_EQ(usually_lit({15, -45, 88}), (Rgb{236, 214, 184}));
  EXPECT_EQ(usually_lit({-15, 45, -88}), (Rgb{52, 47, 40}));
  EXPECT_EQ(usually_lit({1, 0, 0}), (Rgb{113, 102, 88}));
  EXPECT_EQ(usually_lit({0, 1, 0}), (Rgb{66, 60, 51}));
  EXPECT_EQ(usually_lit({0, 0, 1}), (Rgb{215, 195, 167}));
  EXPECT_EQ(usually_lit({2, -3, -6}), (Rgb{63, 57, 49}));
  EXPECT_EQ(usually_lit({2e9, -3e9, -6e9}), (Rgb{63, 57, 49}));
  ImportOptions from_above;
  from_above.lights = {{{0, 0, 1}}};
  // Another surface, another light: white turned towards it stays white.
  EXPECT_EQ(lit({255, 255, 255}, {0, 0, 7}, from_above), (Rgb{255, 255, 255}));
  EXPECT_EQ(lit({200, 100, 0}, {0, 0, -7}, from_above), (Rgb{44, 22, 0}));
}

}  // namespace
}  // namespace halfspace::io
