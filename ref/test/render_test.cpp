#include "halfspace/ref/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "images.hpp"

namespace halfspace::ref {
namespace {

Rendering render_alone(const Scene& scene, const CameraData& camera,
                       const ImageOptions& options = {}) {
  return render(scene, build(scene, {}), camera_of(camera), options);
}

/// A rectangle across the z-axis.
std::vector<GridPoint> rectangle(std::int64_t left, std::int64_t top,
                                 std::int64_t right, std::int64_t bottom,
                                 std::int64_t z) {
  return {
      {left, top, z}, {right, top, z}, {right, bottom, z}, {left, bottom, z}};
}

TEST(RefRender, TheNearerPolygonIsSeen) {
  const Scene scene =
      scene_of({rectangle(0, 0, 3, 2, 1), rectangle(1, 0, 4, 2, 2),
                rectangle(0, 1, 5, 2, 0)});
  EXPECT_EQ((Ids{0, 1, 1, 1, kNone, 0, 1, 1, 1, 2}),
            image_of(scene, from_above(5, 2)));
}

TEST(RefRender, WhatIsAtTheNearDistanceIsUnseen) {
  const Scene scene = scene_of({rectangle(-9, -9, 9, 9, 2)});
  CameraData parallel = from_above(1, 1);
  CameraData central = parallel;
  central.perspective = true;
  central.eye = {0, 0, 0};
  central.s0 = {-128, -128, 2 * 256};  // the wall is at t = 1
  for (auto [camera, at] :
       {std::pair{parallel, -2 * 65536}, std::pair{central, 65536}}) {
    camera.near = at;
    EXPECT_EQ(Ids{kNone}, image_of(scene, camera));
    camera.near = at - 1;
    EXPECT_EQ(Ids{0}, image_of(scene, camera));
  }
}

TEST(RefRender, OfCoplanarPolygonsTheLowestIdIsSeen) {
  Polygons polygons = {rectangle(0, 0, 3, 1, 1), rectangle(2, 0, 5, 1, 1)};
  EXPECT_EQ((Ids{0, 0, 0, 1, 1}),
            image_of(scene_of(polygons), from_above(5, 1)));
  std::swap(polygons[0], polygons[1]);
  std::reverse(polygons[0].begin(), polygons[0].end());  // either orientation
  EXPECT_EQ((Ids{1, 1, 0, 0, 0}),
            image_of(scene_of(polygons), from_above(5, 1)));
}

TEST(RefRender, WherePlanesMeetAtACentreTheSampleDecides) {
  // z = x - 2, seen against z = 0: nearer on the right of x = 2.
  const Scene right =
      scene_of({rectangle(0, 0, 4, 1, 0),
                {{0, 0, -2}, {4, 0, 2}, {4, 1, 2}, {0, 1, -2}}});
  EXPECT_EQ((Ids{0, 0, 1, 1}), image_of(right, from_above(4, 1)));
  const Scene left = scene_of({rectangle(0, 0, 4, 1, 0),
                               {{0, 0, 2}, {4, 0, -2}, {4, 1, -2}, {0, 1, 2}}});
  EXPECT_EQ((Ids{1, 1, 0, 0}), image_of(left, from_above(4, 1)));
  // z = y - 1: nearer below y = 1.
  const Scene below =
      scene_of({rectangle(0, 0, 1, 3, 0),
                {{0, 0, -1}, {1, 0, -1}, {1, 3, 2}, {0, 3, 2}}});
  EXPECT_EQ((Ids{0, 1, 1}), image_of(below, from_above(1, 3)));
  const Scene above =
      scene_of({rectangle(0, 0, 1, 3, 0),
                {{0, 0, 1}, {1, 0, 1}, {1, 3, -2}, {0, 3, -2}}});
  EXPECT_EQ((Ids{1, 0, 0}), image_of(above, from_above(1, 3)));
  // z = x - 4 y: to the right of the centre nearer, though farther below.
  const Scene steep =
      scene_of({rectangle(0, 0, 2, 1, 0),
                {{0, 0, 0}, {2, 0, 2}, {2, 1, -2}, {0, 1, -4}}});
  EXPECT_EQ((Ids{1, 1}), image_of(steep, from_above(2, 1)));
}

TEST(RefRender, CullingLeavesOutWhatIsSeenFromBehind) {
  std::vector<GridPoint> away = rectangle(0, 0, 2, 1, 2);
  std::reverse(away.begin(), away.end());
  const Scene scene = scene_of({away, rectangle(0, 0, 4, 1, 0)});
  EXPECT_EQ((Ids{0, 0, 1, 1}), image_of(scene, from_above(4, 1)));
  EXPECT_EQ((Ids{1, 1, 1, 1}),
            image_of(scene, from_above(4, 1), {.cull = true}));
}

TEST(RefRender, PaintingStopsWhenTheScreenIsFull) {
  const Scene scene =
      scene_of({rectangle(0, 0, 4, 4, 0), rectangle(0, 0, 4, 4, 1),
                rectangle(0, 0, 4, 2, 2), rectangle(0, 0, 4, 4, -1)});
  const Rendering image = render_alone(scene, from_above(4, 4));
  EXPECT_EQ(2u, image.fragments_displayed);
  EXPECT_EQ(16u, image.pixels_painted);
  const Camera camera = camera_of(from_above(4, 4));
  const Rendering painted = paint(scene, build(scene, {}), camera, {});
  EXPECT_EQ(4u, painted.fragments_displayed);
  EXPECT_EQ(56u, painted.pixels_painted);
  // In id order, where nothing nearer was painted before.
  for (const Rendering& other :
       {zbuffer(scene, camera, {}), raycast(scene, camera, {})}) {
    EXPECT_EQ(4u, other.fragments_displayed);
    EXPECT_EQ(40u, other.pixels_painted);
  }
}

TEST(RefRender, AnEmptySceneIsBackground) {
  const Scene scene;
  const ImageOptions options{.background = {1, 2, 3}};
  EXPECT_EQ((Ids{kNone, kNone}), image_of(scene, from_above(2, 1), options));
  const Rendering image = render_alone(scene, from_above(2, 1), options);
  EXPECT_EQ((std::vector<Rgb>{{1, 2, 3}, {1, 2, 3}}), image.colors.pixels);
}

TEST(RefRender, GouraudIsRoundedHalfUp) {
  const Scene scene = scene_of({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}},
                               {{0, 3, 255}, {1, 3, 0}, {0, 3, 0}});
  const Rendering image =
      render_alone(scene, from_above(4, 1), {.shading = Shading::kGouraud});
  // Red is x / 4; blue is 255 (4 - x) / 4.
  EXPECT_EQ(
      (std::vector<Rgb>{{0, 3, 255}, {0, 3, 191}, {1, 3, 128}, {1, 3, 64}}),
      image.colors.pixels);
  const Rendering flat = render_alone(scene, from_above(4, 1));
  EXPECT_EQ(std::vector<Rgb>(4, Rgb{0, 10, 20}), flat.colors.pixels);
}

TEST(RefRender, GouraudIsNotRoundedUpAHairBelowAHalf) {
  const Scene scene = scene_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                               {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}});
  // Red is x; the centre sees 1/2 - start / (2^38 + 2^8).
  for (const int start : {-1, 0, 1}) {
    CameraData camera = from_above(1, 1);
    camera.eye = {1, 0, (1 << 30) + 1};
    camera.s0 = {0, 0, start};
    camera.sy = {0, 128, 0};
    const Rendering image =
        render_alone(scene, camera, {.shading = Shading::kGouraud});
    EXPECT_EQ(start > 0 ? 0 : 1, image.colors.at(0, 0).r) << start;
  }
}

TEST(RefRender, GouraudIsAffineInSpaceAndNotInTheImage) {
  const Scene scene = scene_of({{{0, 0, 1}, {3, 0, 3}, {0, 3, 3}}},
                               {{0, 0, 0}, {200, 0, 0}, {0, 200, 0}});
  CameraData camera;  // sees (i, 0, 4) at the centre of pixel (i, 0)
  camera.s0 = {-32, -32, 256};
  camera.sx = {64, 0, 0};
  camera.sy = {0, 64, 0};
  camera.width_px = 4;
  camera.height_px = 1;
  const Rendering image =
      render_alone(scene, camera, {.shading = Shading::kGouraud});
  // On the edge 3 u / (1 + 2 u) = i / 4 gives u = i / (12 - 2 i).
  EXPECT_EQ((std::vector<Rgb>{{0, 0, 0}, {20, 0, 0}, {50, 0, 0}, {100, 0, 0}}),
            image.colors.pixels);
}

TEST(RefRender, EqualCornerColoursAreConstantOnAnyPolygon) {
  const Scene scene =
      scene_of({rectangle(0, 0, 2, 1, 0)}, std::vector<Rgb>(4, Rgb{7, 8, 9}));
  const Rendering image =
      render_alone(scene, from_above(2, 1), {.shading = Shading::kGouraud});
  EXPECT_EQ(std::vector<Rgb>(2, Rgb{7, 8, 9}), image.colors.pixels);
}

}  // namespace
}  // namespace halfspace::ref
