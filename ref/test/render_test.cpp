#include "halfspace/ref/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "halfspace/ref/painter.hpp"
#include "halfspace/ref/raycast.hpp"
#include "halfspace/ref/zbuffer.hpp"
#include "scenes.hpp"

namespace halfspace::ref {
namespace {

using Ids = std::vector<PolygonId>;
constexpr PolygonId kNone = kBackground;

/// With sanitizers, which slow them down, long tests have fewer scenes.
#ifdef __SANITIZE_ADDRESS__
constexpr int kLess = 4;
#else
constexpr int kLess = 1;
#endif

Rendering render_alone(const Scene& scene, const CameraData& camera,
                       const ImageOptions& options = {}) {
  return render(scene, build(scene, {}), camera_of(camera), options);
}

/// The pixels of the image by every algorithm, which must all agree.
Ids image_of(const Scene& scene, const CameraData& data,
             const ImageOptions& options = {}) {
  const Camera camera = camera_of(data, scene.grid_bits());
  const BspTree tree = build(scene, {});
  const Rendering image = render(scene, tree, camera, options);
  const Rendering others[] = {paint(scene, tree, camera, options),
                              zbuffer(scene, camera, options),
                              raycast(scene, camera, options)};
  const char* names[] = {"painter", "z-buffer", "ray casting"};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(image.items.pixels, others[k].items.pixels) << names[k];
    EXPECT_EQ(image.colors, others[k].colors) << names[k];
  }
  return image.items.pixels;
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

/// Whether the points are the corners of a valid polygon.
bool is_valid(const std::vector<GridPoint>& points, int grid_bits = 26) {
  SceneData data;
  data.grid_bits = grid_bits;
  data.vertices = points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    data.corners.push_back(static_cast<VertexId>(k));
  }
  data.first_corner.push_back(static_cast<std::uint32_t>(points.size()));
  data.colors.resize(1);
  return make_scene(std::move(data)).has_value();
}

/// Scenes of few small integers, and cameras that look at them from the worst
/// places, along the worst directions.
class Trouble {
 public:
  explicit Trouble(unsigned seed) : random_(seed) {}

  Scene scene() {
    polygons_.clear();
    std::vector<Rgb> colors;
    const bool shaded = chance(2);
    const int count = number(1, 9);
    while (std::ssize(polygons_) < count) {
      const std::optional<std::vector<GridPoint>> polygon =
          shaded || chance(2) ? triangle() : parallelogram();
      if (polygon) polygons_.push_back(*polygon);
    }
    if (shaded) {
      for (std::size_t k = 0; k < 3 * polygons_.size(); ++k) {
        colors.push_back({channel(), channel(), channel()});
      }
    }
    return scene_of(polygons_, colors);
  }

  /// A camera for the last scene. The centres of pixels are grid points of its
  /// picture, or of one 2 or 4 times finer.
  CameraData camera() {
    for (;;) {
      CameraData data;
      data.width_px = number(1, 9);
      data.height_px = number(1, 9);
      data.perspective = !chance(3);
      const Int128 step = 256 >> number(0, 2);
      data.sx = scaled(direction(), step);
      data.sy = scaled(direction(), step);
      data.eye = data.perspective ? place() : scaled(direction(), 256);
      if (chance(3)) data.near = number(0, 3) * 32768;
      if (!data.perspective && data.near) *data.near -= 65536;
      // The eye's ray through a centre near the middle of the picture goes
      // through a corner, or at least somewhere.
      const LatticeVector target = chance(2) ? place() : corner();
      const auto aim = [&](Int128 at, Int128 sx, Int128 sy) {
        return at - sx * (data.width_px / 2) - sx / 2 -
               sy * (data.height_px / 2) - sy / 2;
      };
      data.s0 = {aim(target.x, data.sx.x, data.sy.x),
                 aim(target.y, data.sx.y, data.sy.y),
                 aim(target.z, data.sx.z, data.sy.z)};
      if (make_camera(data, 26)) return data;
    }
  }

 private:
  int number(int least, int greatest) {
    return std::uniform_int_distribution<int>(least, greatest)(random_);
  }
  bool chance(int of) { return number(1, of) == 1; }
  std::uint8_t channel() { return static_cast<std::uint8_t>(number(0, 255)); }
  GridPoint grid_point() {
    // A new point, or a corner that is there, so that much is shared.
    if (!polygons_.empty() && chance(2)) {
      const auto& polygon = polygons_[random_() % polygons_.size()];
      return polygon[random_() % polygon.size()];
    }
    return {number(-3, 3), number(-3, 3), number(-3, 3)};
  }
  std::optional<std::vector<GridPoint>> triangle() {
    const std::vector<GridPoint> corners = {grid_point(), grid_point(),
                                            grid_point()};
    if (!is_valid(corners)) return std::nullopt;
    return corners;
  }
  std::optional<std::vector<GridPoint>> parallelogram() {
    const GridPoint p = grid_point(), q = grid_point(), r = grid_point();
    const std::vector<GridPoint> corners = {
        p, q, {q.x + r.x - p.x, q.y + r.y - p.y, q.z + r.z - p.z}, r};
    if (!is_valid(corners)) return std::nullopt;
    return corners;
  }
  GridPoint direction() {
    if (chance(3)) return {number(-1, 1), number(-1, 1), number(-1, 1)};
    GridPoint axis;
    const int sign = chance(2) ? 1 : -1;
    (chance(3) ? axis.x : chance(2) ? axis.y : axis.z) = sign;
    return axis;
  }
  static LatticeVector scaled(const GridPoint& p, Int128 scale) {
    return {scale * p.x, scale * p.y, scale * p.z};
  }
  LatticeVector corner() {
    const auto& polygon = polygons_[random_() % polygons_.size()];
    return scaled(polygon[random_() % polygon.size()], 256);
  }
  /// A point: of the plane of a polygon, on one of its edges, at a corner, or
  /// anywhere.
  LatticeVector place() {
    const auto& polygon = polygons_[random_() % polygons_.size()];
    const GridPoint& p = polygon[0];
    const GridPoint& q = polygon[1];
    const GridPoint& r = polygon[2];
    const auto mix = [&](Int128 a, Int128 b, Int128 c) {
      return LatticeVector{a * p.x + b * q.x + c * r.x,
                           a * p.y + b * q.y + c * r.y,
                           a * p.z + b * q.z + c * r.z};
    };
    switch (number(0, 5)) {
      case 0:
        return mix(256, 0, 0);  // a corner
      case 1:
        return mix(128, 128, 0);  // on an edge
      case 2:
        return mix(128, 64, 64);  // within
      case 3:
        return mix(256, 256, -256);  // in the plane
      default:
        return scaled({number(-5, 5), number(-5, 5), number(-5, 5)}, 256);
    }
  }

  std::mt19937 random_;
  Polygons polygons_;
};

TEST(RefRender, AllAlgorithmsAgreeWhereItHurts) {
  constexpr int kSeeds = 600 / kLess;
  int seen = 0;
  int edge_on = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Trouble trouble(seed);
    const Scene scene = trouble.scene();
    const std::vector<Plane> planes = planes_of(scene);
    for (int round = 0; round < 3; ++round) {
      const CameraData data = trouble.camera();
      const ImageOptions options{.cull = round == 2,
                                 .shading = Shading::kGouraud};
      const Ids image = image_of(scene, data, options);
      if (HasFailure()) return;
      const auto is_polygon = [](PolygonId id) { return id != kNone; };
      if (std::any_of(image.begin(), image.end(), is_polygon)) ++seen;
      const Camera camera = camera_of(data);
      const auto holds_eye = [&](const Plane& plane) {
        return side_of_eye(plane, camera) == Side::kOn;
      };
      if (std::any_of(planes.begin(), planes.end(), holds_eye)) ++edge_on;
    }
  }
  // What the cameras are for did come up.
  EXPECT_GT(seen, kSeeds);
  EXPECT_GT(edge_on, kSeeds);
}

/// One of the two ends of a range, a neighbour of an end, 0, or anything.
Int128 extreme(std::mt19937& random, Int128 least, Int128 greatest) {
  switch (random() % 6) {
    case 0:
      return least;
    case 1:
      return greatest;
    case 2:
      return least + static_cast<Int128>(random() % 3);
    case 3:
      return 0;
    default: {
      const Int128 wide = static_cast<Int128>(random()) << 64 |
                          static_cast<Int128>(random()) << 32 | random();
      return least + wide % (greatest - least + 1);
    }
  }
}

TEST(RefRender, AllAlgorithmsAgreeAtTheLimitsOfTheGrid) {
  constexpr int kRounds = 400 / kLess;
  constexpr int kBits = 54;
  constexpr Int128 kEnd = Int128{1} << (kBits - 1);
  constexpr Int128 kCameraEnd = kEnd << (kLatticeBits + kCameraRangeBits);
  std::mt19937 random(1);
  const auto coordinate = [&] {
    return static_cast<std::int64_t>(extreme(random, -kEnd, kEnd - 1));
  };
  const auto vector = [&](Int128 end) -> LatticeVector {
    return {extreme(random, -end, end), extreme(random, -end, end),
            extreme(random, -end, end)};
  };
  int seen = 0;
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Polygons polygons;
    while (polygons.size() < 4) {
      std::vector<GridPoint> corners;
      for (int k = 0; k < 3; ++k) {
        corners.push_back({coordinate(), coordinate(), coordinate()});
      }
      if (is_valid(corners, kBits)) polygons.push_back(corners);
    }
    CameraData camera;
    camera.perspective = random() % 3 != 0;
    const Int128 near_scene = kEnd << kLatticeBits;
    camera.eye = vector(random() % 2 == 0 ? kCameraEnd : near_scene);
    camera.s0 = vector(random() % 2 == 0 ? kCameraEnd : near_scene);
    camera.sx = vector(near_scene);
    camera.sy = vector(near_scene);
    camera.width_px = 7;
    camera.height_px = 5;
    if (random() % 3 == 0) {
      const Int128 end = Int128{1} << 32;
      camera.near = static_cast<std::int64_t>(
          extreme(random, camera.perspective ? 0 : -end, end));
    }
    if (!make_camera(camera, kBits)) continue;
    const Ids image = image_of(scene_of(polygons, {}, kBits), camera);
    if (HasFailure()) return;
    if (std::count(image.begin(), image.end(), kNone) < 35) ++seen;
  }
  EXPECT_GT(seen, kRounds / 20);
}

}  // namespace
}  // namespace halfspace::ref
