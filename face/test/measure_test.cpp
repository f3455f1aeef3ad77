#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "halfspace/halfspace.hpp"

namespace halfspace {
namespace {

TEST(FaceMeasure, ABoxHasItsVolumeAreaCentroidAndInertia) {
  const Solid box = Solid::box({0, 0, 0}, {1, 2, 3}).translated({10, 0, 0});
  EXPECT_EQ(*box.volume(), 6);
  EXPECT_EQ(*box.exact_volume(), "6");
  EXPECT_EQ(*box.area(), 22);
  EXPECT_EQ(**box.exact_area(), "22");
  EXPECT_EQ(*box.centroid(), (Point{10.5, 1, 1.5}));
  EXPECT_EQ(*box.bounds(), (Bounds{{10, 0, 0}, {11, 2, 3}}));
  const auto inertia = *box.inertia();
  // m (b^2 + c^2) / 12 about each axis, and nothing else.
  EXPECT_EQ(inertia[0][0], 6.0 * (4 + 9) / 12);
  EXPECT_EQ(inertia[1][1], 6.0 * (1 + 9) / 12);
  EXPECT_EQ(inertia[2][2], 6.0 * (1 + 4) / 12);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (i != j) {
        EXPECT_EQ(inertia[i][j], 0);
      }
    }
  }
}

TEST(FaceMeasure, DecimalsAreWhatTheyWereTypedAs) {
  const Solid box = Solid::box({0, 0, 0}, {0.1, 0.2, 0.3});
  EXPECT_EQ(*box.exact_volume(), "0.006");
  EXPECT_EQ(*box.volume(), 0.006);
}

TEST(FaceMeasure, RationalVolumesAreFractions) {
  // A corner of a cube, cut by a plane through no grid point of three edges.
  const Solid corner =
      Solid::box({0, 0, 0}, {1, 1, 1}) & Solid::half_space({{1, 2, 3}, 1});
  EXPECT_EQ(*corner.exact_volume(), "1/36");
  EXPECT_EQ(*corner.volume(), 1.0 / 36);
  // Its slanted face has an irrational area.
  EXPECT_FALSE(corner.exact_area()->has_value());
  const double slanted = std::sqrt(14.0) / 12;
  EXPECT_NEAR(*corner.area(), slanted + (1.0 / 4 + 1.0 / 6 + 1.0 / 12), 1e-15);
}

TEST(FaceMeasure, RoundSolidsComeNearTheirVolumes) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_NEAR(*Solid::sphere(1, 64).volume(), 4 * kPi / 3, 2e-2);
  EXPECT_NEAR(*Solid::cylinder(2, 3, 256).volume(), 12 * kPi, 5e-3);
  EXPECT_NEAR(*Solid::cone(2, 0, 3, 256).volume(), 4 * kPi, 2e-3);
  EXPECT_NEAR(*Solid::cone(0, 2, 3, 256).volume(), 4 * kPi, 2e-3);
  EXPECT_NEAR(*Solid::torus(3, 1, 64, 64).volume(), 6 * kPi * kPi, 0.3);
  const Solid sphere = Solid::sphere(5).translated({1, 2, 3});
  const Point centre = *sphere.centroid();
  EXPECT_NEAR(centre.x, 1, 1e-9);
  EXPECT_NEAR(centre.y, 2, 1e-9);
  EXPECT_NEAR(centre.z, 3, 1e-9);
}

TEST(FaceMeasure, HandlesAndShellsAreCounted) {
  EXPECT_EQ(*Solid::box({0, 0, 0}, {1, 1, 1}).genus(), 0);
  EXPECT_EQ(*Solid::torus(3, 1, 12, 8).genus(), 1);
  const Solid plate = Solid::box({0, 0, 0}, {9, 9, 1});
  const Solid pin = Solid::box({1, 1, -1}, {2, 2, 2});
  const Solid drilled = plate - pin - pin.translated({3, 0, 0});
  EXPECT_EQ(*drilled.genus(), 2);
  EXPECT_EQ(*drilled.shell_count(), 1u);
  // A cavity is a shell of its own; boxes that share an edge are two.
  const Solid hollow =
      Solid::box({0, 0, 0}, {9, 9, 9}) - Solid::box({1, 1, 1}, {8, 8, 8});
  EXPECT_EQ(*hollow.shell_count(), 2u);
  EXPECT_EQ(*hollow.genus(), 0);
  const Solid cube = Solid::box({0, 0, 0}, {1, 1, 1});
  const Solid along_edge = cube + cube.translated({1, 1, 0});
  EXPECT_EQ(*along_edge.shell_count(), 2u);
  EXPECT_EQ(*along_edge.genus(), 0);
  // Taken out of a block, they leave one hole: at the edge the solid ends.
  const Solid block = Solid::box({-1, -1, 0}, {3, 3, 1});
  EXPECT_EQ(*(block - along_edge).genus(), 1);
}

TEST(FaceMeasure, TheEmptySolidHasNoCentre) {
  EXPECT_EQ(*Solid().volume(), 0);
  EXPECT_TRUE(*Solid().is_empty());
  EXPECT_EQ(Solid().centroid().error().code, ErrorCode::kEmpty);
  EXPECT_EQ(Solid().bounds().error().code, ErrorCode::kEmpty);
}

}  // namespace
}  // namespace halfspace
