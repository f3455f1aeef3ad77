#include "halfspace/ref/scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "halfspace/image.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "scenes.hpp"

namespace halfspace::ref {
namespace {

using Segments = std::vector<ObjectSegment>;

/// What the camera sees of one polygon alone.
Segments seen(const std::vector<GridPoint>& polygon, const CameraData& camera) {
  const Scene scene = scene_of({polygon});
  return scan_convert(whole(scene, 0), projection_of(camera_of(camera)));
}

/// How often each pixel of the camera is covered, row by row.
std::vector<int> covers(const Polygons& polygons, const CameraData& camera) {
  Grid2<int> count(camera.width_px, camera.height_px, 0);
  for (const std::vector<GridPoint>& polygon : polygons) {
    for (const auto& [line, span] : seen(polygon, camera)) {
      for (std::int32_t i = span.first; i <= span.last; ++i) {
        ++count.at(i, line);
      }
    }
  }
  return count.pixels;
}

/// An eye at the origin that sees the grid point (x, y, 4) at the very centre
/// of pixel (x + 4, y + 4), of 9 x 9.
CameraData from_origin() {
  CameraData data;
  data.s0 = {-4 * 256 - 128, -4 * 256 - 128, 4 * 256};
  data.sx = {256, 0, 0};
  data.sy = {0, 256, 0};
  data.width_px = 9;
  data.height_px = 9;
  return data;
}

Segments whole_image(const CameraData& camera) {
  Segments segments;
  for (std::int32_t j = 0; j < camera.height_px; ++j) {
    segments.push_back({j, {0, camera.width_px - 1}});
  }
  return segments;
}

TEST(RefScan, LeftAndTopEdgesThroughCentresAreIn) {
  const std::vector<GridPoint> square = {
      {1, 1, 0}, {4, 1, 0}, {4, 4, 0}, {1, 4, 0}};
  EXPECT_EQ((Segments{{1, {1, 3}}, {2, {1, 3}}, {3, {1, 3}}}),
            seen(square, from_above(6, 6)));
}

TEST(RefScan, CentresOnADiagonalAreOnItsRight) {
  // y = x, and the triangles on its right and on its left.
  EXPECT_EQ((Segments{{0, {0, 3}}, {1, {1, 3}}, {2, {2, 3}}, {3, {3, 3}}}),
            seen({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}, from_above(6, 6)));
  EXPECT_EQ((Segments{{1, {0, 0}}, {2, {0, 1}}, {3, {0, 2}}}),
            seen({{0, 0, 0}, {4, 4, 0}, {0, 4, 0}}, from_above(6, 6)));
  // y = 4 - x.
  EXPECT_EQ((Segments{{1, {3, 3}}, {2, {2, 3}}, {3, {1, 3}}}),
            seen({{4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, from_above(6, 6)));
  EXPECT_EQ((Segments{{0, {0, 3}}, {1, {0, 2}}, {2, {0, 1}}, {3, {0, 0}}}),
            seen({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, from_above(6, 6)));
}

TEST(RefScan, TheShiftToTheRightOutweighsTheShiftDown) {
  // The edge from (0, 0) to (5, 1) falls so slowly that e * e takes a point of
  // it further than one pixel's e would if the two shifts were equal.
  EXPECT_EQ((Segments{{0, {0, 4}}}),
            seen({{0, 0, 0}, {5, 0, 0}, {5, 1, 0}}, from_above(6, 6)));
  EXPECT_EQ(Segments{},
            seen({{0, 0, 0}, {5, 1, 0}, {0, 1, 0}}, from_above(6, 6)));
  // The same, rising: the centre (5, 0) is right of it, and beyond the side.
  EXPECT_EQ((Segments{{0, {0, 4}}}),
            seen({{0, 0, 0}, {5, 0, 0}, {0, 1, 0}}, from_above(6, 6)));
  EXPECT_EQ(Segments{},
            seen({{5, 0, 0}, {5, 1, 0}, {0, 1, 0}}, from_above(6, 6)));
}

TEST(RefScan, SquaresThatShareEdgesThroughCentresCoverEachPixelOnce) {
  Polygons squares;
  for (std::int64_t y = 0; y < 3; ++y) {
    for (std::int64_t x = 0; x < 3; ++x) {
      squares.push_back({{2 * x, 2 * y, 0},
                         {2 * x + 2, 2 * y, 0},
                         {2 * x + 2, 2 * y + 2, 0},
                         {2 * x, 2 * y + 2, 0}});
    }
  }
  EXPECT_EQ(std::vector<int>(36, 1), covers(squares, from_above(6, 6)));
}

TEST(RefScan, AFanRoundACentreCoversEachPixelOnce) {
  const GridPoint hub = {3, 3, 0};
  const std::vector<GridPoint> rim = {
      {0, 0, 0}, {2, 0, 0}, {3, 0, 0}, {5, 0, 0}, {6, 0, 0}, {6, 3, 0},
      {6, 5, 0}, {6, 6, 0}, {3, 6, 0}, {1, 6, 0}, {0, 6, 0}, {0, 3, 0}};
  Polygons fan;
  for (std::size_t k = 0; k < rim.size(); ++k) {
    fan.push_back({hub, rim[k], rim[(k + 1) % rim.size()]});
  }
  EXPECT_EQ(std::vector<int>(36, 1), covers(fan, from_above(6, 6)));
}

TEST(RefScan, AStraightCornerChangesNothing) {
  const CameraData camera = from_above(8, 8);
  EXPECT_EQ(seen({{1, 1, 0}, {7, 3, 0}, {2, 7, 0}}, camera),
            seen({{1, 1, 0}, {4, 2, 0}, {7, 3, 0}, {2, 7, 0}}, camera));
}

TEST(RefScan, BothOrientationsCoverTheSame) {
  std::vector<GridPoint> polygon = {{1, 1, 2}, {7, 3, 0}, {2, 7, 1}};
  const Segments front = seen(polygon, from_above(8, 8));
  std::reverse(polygon.begin(), polygon.end());
  EXPECT_FALSE(front.empty());
  EXPECT_EQ(front, seen(polygon, from_above(8, 8)));
}

TEST(RefScan, TheImageClips) {
  const CameraData camera = from_above(5, 4);
  EXPECT_EQ(whole_image(camera),
            seen({{-100, -100, 0}, {300, -90, 7}, {-80, 300, 1}}, camera));
  EXPECT_EQ((Segments{{0, {0, 1}}, {1, {0, 1}}}),
            seen({{-9, -9, 0}, {2, -9, 0}, {2, 2, 0}, {-9, 2, 0}}, camera));
  EXPECT_EQ((Segments{{2, {3, 4}}, {3, {3, 4}}}),
            seen({{3, 2, 0}, {9, 2, 0}, {9, 9, 0}, {3, 9, 0}}, camera));
  EXPECT_EQ(Segments{}, seen({{5, 0, 0}, {9, 0, 0}, {9, 9, 0}}, camera));
}

TEST(RefScan, APolygonSeenEdgeOnCoversNothing) {
  EXPECT_EQ(Segments{},
            seen({{1, 1, 0}, {4, 1, 0}, {4, 1, 9}}, from_above(6, 6)));
  // The planes y = 0 and x = y.
  EXPECT_EQ(Segments{},
            seen({{-9, 0, 1}, {9, 0, 1}, {0, 0, 90}}, from_origin()));
  EXPECT_EQ(Segments{},
            seen({{-9, -9, 1}, {9, 9, 1}, {1, 1, 90}}, from_origin()));
}

TEST(RefScan, APolygonOnTheSideOfTheViewVolumeCoversNothing) {
  CameraData camera = from_above(6, 6);
  camera.s0 = {0, 0, 0};  // the image's left and top sides are x = 0, y = 0
  EXPECT_EQ(Segments{}, seen({{0, 1, 0}, {0, 5, 0}, {0, 1, 5}}, camera));
  EXPECT_EQ(Segments{}, seen({{1, 0, 0}, {5, 0, 0}, {1, 0, 5}}, camera));
  EXPECT_EQ(Segments{}, seen({{6, 1, 0}, {6, 5, 0}, {6, 1, 5}}, camera));
  // Those that touch it from outside and from inside.
  EXPECT_EQ(Segments{}, seen({{0, 0, 0}, {0, 6, 0}, {-6, 6, 5}}, camera));
  EXPECT_EQ(5u, seen({{0, 0, 0}, {0, 6, 0}, {6, 6, 5}}, camera).size());
}

TEST(RefScan, TheEyeOnAPolygonSeesNothingOfIt) {
  const CameraData camera = from_origin();
  // At a corner, on an edge, within; across and along the view.
  EXPECT_EQ(Segments{}, seen({{0, 0, 0}, {9, 0, 9}, {0, 9, 9}}, camera));
  EXPECT_EQ(Segments{}, seen({{-9, 0, -9}, {9, 0, 9}, {0, 9, 9}}, camera));
  EXPECT_EQ(Segments{}, seen({{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, camera));
  EXPECT_EQ(Segments{}, seen({{-9, 0, -9}, {9, 0, -9}, {0, 0, 9}}, camera));
}

TEST(RefScan, OnlyWhatIsBeforeTheEyeIsSeen) {
  const CameraData camera = from_origin();
  EXPECT_EQ(Segments{}, seen({{-9, -9, -4}, {9, -9, -4}, {0, 9, -4}}, camera));
  // The plane y = 1 below the eye runs from behind it to z = 4: the lower half
  // of the image from the line y = 1 on, which is the row of centres j = 5.
  EXPECT_EQ(
      (Segments{{5, {0, 8}}, {6, {0, 8}}, {7, {0, 8}}, {8, {0, 8}}}),
      seen({{-99, 1, -50}, {99, 1, -50}, {99, 1, 4}, {-99, 1, 4}}, camera));
  // The same above the eye, y = -1: the row of centres j = 3 is its edge, and
  // the samples there are below it.
  EXPECT_EQ(
      (Segments{{0, {0, 8}}, {1, {0, 8}}, {2, {0, 8}}}),
      seen({{-99, -1, -50}, {99, -1, -50}, {99, -1, 4}, {-99, -1, 4}}, camera));
}

TEST(RefScan, WhatIsAtTheNearDistanceIsUnseen) {
  CameraData camera = from_origin();
  const std::vector<GridPoint> wall = {
      {-90, -90, 4}, {90, -90, 4}, {90, 90, 4}, {-90, 90, 4}};  // t = 1
  const std::vector<GridPoint> floor = {
      {-90, 1, -4}, {90, 1, -4}, {90, 1, 90}, {-90, 1, 90}};
  camera.near = 65535;
  EXPECT_EQ(whole_image(camera), seen(wall, camera));
  camera.near = 65536;
  EXPECT_EQ(Segments{}, seen(wall, camera));
  camera.near = 0;
  EXPECT_EQ(whole_image(camera), seen(wall, camera));
  EXPECT_EQ(4u, seen(floor, camera).size());
  // The floor at t = 1/2 is two rows below the horizon, at t = 1 one. Its
  // points beyond are above that line, where the sample is not.
  camera.near = 65536 / 2;
  EXPECT_EQ((Segments{{5, {0, 8}}}), seen(floor, camera));
  camera.near = 65536;
  EXPECT_EQ(Segments{}, seen(floor, camera));
}

TEST(RefScan, AnEyeAtInfinityHasANearDistanceOnlyIfGivenOne) {
  CameraData camera = from_above(6, 6);
  const std::vector<GridPoint> far_away = {
      {0, 0, -900}, {6, 0, -900}, {6, 6, -900}, {0, 6, -900}};
  const std::vector<GridPoint> behind = {
      {0, 0, 900}, {6, 0, 900}, {6, 6, 900}, {0, 6, 900}};
  const std::vector<GridPoint> upright = {
      {0, 0, 3}, {6, 0, -3}, {6, 6, -3}, {0, 6, 3}};  // x + z = 3
  EXPECT_EQ(whole_image(camera), seen(far_away, camera));
  EXPECT_EQ(whole_image(camera), seen(behind, camera));
  camera.near = 0;  // z < 0
  EXPECT_EQ(whole_image(camera), seen(far_away, camera));
  EXPECT_EQ(Segments{}, seen(behind, camera));
  const Segments right = seen(upright, camera);
  ASSERT_EQ(6u, right.size());
  EXPECT_EQ((Span{3, 5}), right[0].span);
  camera.near = -3 * 65536;  // z < 3
  EXPECT_EQ(whole_image(camera), seen(upright, camera));
  camera.near = -2 * 65536;  // z < 2
  EXPECT_EQ((Span{1, 5}), seen(upright, camera)[0].span);
}

/// Two rectangles that cross, one over both, and one seen from behind.
const Polygons kFour = {{{0, 0, 0}, {6, 0, 6}, {6, 4, 6}, {0, 4, 0}},
                        {{0, 0, 3}, {6, 0, 3}, {6, 4, 3}, {0, 4, 3}},
                        {{1, 1, 9}, {3, 1, 9}, {3, 3, 9}, {1, 3, 9}},
                        {{4, 4, 9}, {6, 4, 9}, {6, 0, 9}, {4, 0, 9}}};

TEST(RefRaycast, ARayAloneSeesWhatItSeesInTheImage) {
  const Scene scene = scene_of(kFour);
  const Camera camera = camera_of(from_above(7, 5));
  const std::vector<PolygonId> all = {0, 1, 2, 3};
  const std::vector<PolygonId> some = {1, 3};
  for (const bool cull : {false, true}) {
    const ImageOptions options{.cull = cull};
    const ItemImage image = raycast(scene, camera, options).items;
    for (std::int32_t j = 0; j < 5; ++j) {
      for (std::int32_t i = 0; i < 7; ++i) {
        EXPECT_EQ(image.at(i, j),
                  raycast_at(scene, camera, options, i, j, all));
        const PolygonId found = raycast_at(scene, camera, options, i, j, some);
        EXPECT_TRUE(found == kBackground || found == 1 || found == 3);
      }
    }
    EXPECT_EQ(cull ? 0 : 3, raycast_at(scene, camera, options, 5, 2, all));
    EXPECT_EQ(cull ? 1 : 3, raycast_at(scene, camera, options, 5, 2, some));
    EXPECT_EQ(2, raycast_at(scene, camera, options, 2, 2, all));
  }
}

TEST(RefPainter, ABlendIsBetweenNothingAndThePainting) {
  const Scene scene = scene_of(kFour);
  const Camera camera = camera_of(from_above(7, 5));
  const BspTree tree = build(scene, {});
  const ImageOptions options{.background = {200, 100, 0}};
  const Rendering painted = paint(scene, tree, camera, options);
  const Rendering opaque = blend(scene, tree, camera, options, kOpaque);
  EXPECT_EQ(painted.items, opaque.items);
  EXPECT_EQ(painted.colors, opaque.colors);
  const Rendering unseen = blend(scene, tree, camera, options, 0);
  EXPECT_EQ(painted.items, unseen.items);
  for (const Rgb& color : unseen.colors.pixels)
    EXPECT_EQ(options.background, color);
  // One over the other at pixel (2, 2): 0, 1 and 2 have 10 of green.
  const Rendering half = blend(scene, tree, camera, options, 51);
  // 0.2 10 + 0.8 100 = 82; 67.6 is 68; 0.2 10 + 0.8 68 = 56.4.
  EXPECT_EQ(56, half.colors.at(2, 2).g);
}

}  // namespace
}  // namespace halfspace::ref
