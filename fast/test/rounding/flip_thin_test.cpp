#include "rounding/flip_thin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace halfspace::fast {
namespace {

/// A triangle in the plane z = 0 with corners that lie nearly on its base,
/// which a fan from the first one cuts off: the last corner is far away.
struct Fan {
  GridMesh mesh;
  std::vector<LoosePoint> loose;
  std::vector<std::int32_t> plane;
};

Fan flat_fan(int corners_on_base) {
  Fan fan;
  const std::int64_t width = 1 << 20;
  for (int i = 0; i < corners_on_base; ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const double x = static_cast<double>(width) * i / (corners_on_base - 1);
    // Corners that turn by far less than a step.
    const double y = (x - 0x1p19) * (x - 0x1p19) * 0x1p-42;
    fan.loose.push_back({id, {x, y, 0}});
    fan.mesh.points.push_back({});
  }
  fan.mesh.points.push_back({width / 2, width, 0});
  const std::int32_t top = corners_on_base;
  fan.mesh.moved.resize(fan.mesh.points.size());
  for (std::int32_t i = 1; i < top; ++i)
    fan.mesh.triangles.push_back({{0, i, i + 1}, i});
  fan.plane.assign(fan.mesh.triangles.size(), 0);
  return fan;
}

std::vector<StepPoint> places_of(const Fan& fan) {
  std::vector<StepPoint> places;
  for (const GridPoint& p : fan.mesh.points)
    places.push_back({double(p.x), double(p.y), double(p.z)});
  for (const LoosePoint& p : fan.loose)
    places[static_cast<std::size_t>(p.point)] = p.at;
  return places;
}

double twice_area(const Fan& fan, const GridTriangle& t) {
  const auto places = places_of(fan);
  const auto at = [&](std::size_t i) {
    return places[static_cast<std::size_t>(t.corners[i])];
  };
  return (at(1)[0] - at(0)[0]) * (at(2)[1] - at(0)[1]) -
         (at(1)[1] - at(0)[1]) * (at(2)[0] - at(0)[0]);
}

TEST(FastFlipThin, CornersOnABaseAreJoinedWithTheFarOne) {
  for (const int count : {3, 4, 9, 40}) {
    Fan fan = flat_fan(count);
    double before = 0, after = 0;
    for (const GridTriangle& t : fan.mesh.triangles)
      before += twice_area(fan, t);
    const auto flipped = flip_thin(fan.mesh, fan.loose, fan.plane, 16);
    EXPECT_GE(flipped.size(), static_cast<std::size_t>(count - 2));
    for (const GridTriangle& t : fan.mesh.triangles) {
      EXPECT_NE(std::find(t.corners.begin(), t.corners.end(), count),
                t.corners.end());
      EXPECT_GT(twice_area(fan, t), 0x1p30);
      after += twice_area(fan, t);
    }
    EXPECT_NEAR(before, after, 1);
  }
}

TEST(FastFlipThin, EdgesBetweenPlanesStay) {
  Fan fan = flat_fan(9);
  for (std::size_t t = 0; t < fan.plane.size(); ++t)
    fan.plane[t] = static_cast<std::int32_t>(t);
  EXPECT_TRUE(flip_thin(fan.mesh, fan.loose, fan.plane, 16).empty());
}

TEST(FastFlipThin, NothingIsDoneWhereNothingIsLooseOrThin) {
  Fan fan = flat_fan(9);
  EXPECT_TRUE(flip_thin(fan.mesh, {}, fan.plane, 16).empty());
  EXPECT_TRUE(flip_thin(fan.mesh, fan.loose, fan.plane, 0).empty());
}

}  // namespace
}  // namespace halfspace::fast
