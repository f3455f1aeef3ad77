#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "images.hpp"

namespace halfspace::ref {
namespace {

/// With sanitizers, which slow them down, long tests have fewer scenes.
#ifdef __SANITIZE_ADDRESS__
constexpr int kLess = 4;
#else
constexpr int kLess = 1;
#endif

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
