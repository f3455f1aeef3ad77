#include <algorithm>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "generate/shapes.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

template <class Impl>
class S1Geometry : public ::testing::Test {};
TYPED_TEST_SUITE(S1Geometry, Implementations);

/// Points about a scene: its vertices, and those one step off, on the grid.
std::vector<GridPoint> points_about(const Scene& scene) {
  std::vector<GridPoint> points = {{0, 0, 0}, {1, -2, 3}};
  for (const GridPoint& p : scene.data().vertices) {
    points.push_back(p);
    points.push_back({p.x + (p.x < 0 ? 1 : -1), p.y, p.z});
    points.push_back({p.x, p.y + (p.y < 0 ? 1 : -1), p.z});
    points.push_back({p.x, p.y, p.z + (p.z < 0 ? 1 : -1)});
  }
  return points;
}

Side side_of_sign(int sign) { return static_cast<Side>(sign); }

TYPED_TEST(S1Geometry, L1TheOppositePlaneHasTheOppositeSides) {
  std::size_t sides[3] = {0, 0, 0};
  law::for_all_views([&](const SceneFile& view) {
    const Scene turned = reversed(view.scene);
    for (const PolygonId p : ids_of(view.scene)) {
      const auto plane = definition::plane_of(view.scene, p);
      for (const GridPoint& point : points_about(view.scene)) {
        const Side side = TypeParam::side_of(view.scene, p, point);
        HALFSPACE_LAW(side == side_of_sign(definition::side_of(
                                  plane, definition::to_point(point))));
        HALFSPACE_LAW(TypeParam::side_of(turned, p, point) == opposite(side));
        ++sides[static_cast<int>(side) + 1];
      }
      // The same for the eye, which may be at infinity.
      const Side eye = TypeParam::side_of_eye(view.scene, p, *view.camera);
      HALFSPACE_LAW(eye ==
                    side_of_sign(definition::side_of_eye(plane, *view.camera)));
      HALFSPACE_LAW(TypeParam::side_of_eye(turned, p, *view.camera) ==
                    opposite(eye));
    }
  });
  for (const std::size_t count : sides) EXPECT_GT(count, 1000u);
}

TYPED_TEST(S1Geometry, L2CornersAreOnThePlaneAndReversedOnTheOpposite) {
  law::for_all_views([](const SceneFile& view) {
    const Scene turned = reversed(view.scene);
    for (const PolygonId p : ids_of(view.scene)) {
      for (const VertexId vertex : view.scene.corners(p)) {
        const GridPoint& corner = view.scene.point(vertex);
        HALFSPACE_LAW(TypeParam::side_of(view.scene, p, corner) == Side::kOn);
        HALFSPACE_LAW(TypeParam::side_of(turned, p, corner) == Side::kOn);
      }
      for (const GridPoint& point : points_about(view.scene)) {
        HALFSPACE_LAW(TypeParam::side_of(turned, p, point) ==
                      opposite(TypeParam::side_of(view.scene, p, point)));
      }
    }
  });
}

TYPED_TEST(S1Geometry, L3MovingAllByOneVectorChangesNoSide) {
  std::size_t moved_scenes = 0;
  law::for_all_views([&](const SceneFile& view) {
    for (const GridPoint by :
         {GridPoint{7, -3, 1}, GridPoint{-2, -9, 40}, GridPoint{0, 1, 0}}) {
      const auto moved = [&](const GridPoint& p) {
        return GridPoint{p.x + by.x, p.y + by.y, p.z + by.z};
      };
      SceneData data = view.scene.data();
      for (GridPoint& p : data.vertices) p = moved(p);
      const auto scene = make_scene(std::move(data));
      if (!scene) continue;  // beyond the grid's limit
      ++moved_scenes;
      for (const PolygonId p : ids_of(view.scene)) {
        for (const GridPoint& point : points_about(view.scene)) {
          HALFSPACE_LAW(TypeParam::side_of(*scene, p, moved(point)) ==
                        TypeParam::side_of(view.scene, p, point));
        }
      }
    }
  });
  EXPECT_GT(moved_scenes, 100u);
}

/// The data of a scene with one polygon.
SceneData data_of(const std::vector<GridPoint>& polygon, int grid_bits) {
  SceneData data;
  data.grid_bits = grid_bits;
  data.vertices = polygon;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    data.corners.push_back(static_cast<VertexId>(k));
  data.first_corner.push_back(static_cast<std::uint32_t>(polygon.size()));
  data.colors.push_back({1, 2, 3});
  return data;
}

/// The corners of a polygon, doubled, with the middle of every edge.
std::vector<GridPoint> with_middles(const Scene& scene, PolygonId p) {
  std::vector<GridPoint> points;
  const auto corners = scene.corners(p);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const GridPoint& a = scene.point(corners[k]);
    const GridPoint& b = scene.point(corners[(k + 1) % corners.size()]);
    points.push_back({2 * a.x, 2 * a.y, 2 * a.z});
    points.push_back({a.x + b.x, a.y + b.y, a.z + b.z});
  }
  return points;
}

TYPED_TEST(S1Geometry, L4APolygonMayStartAnywhereAndHaveStraightCorners) {
  std::size_t accepted = 0;
  law::for_all_views([&](const SceneFile& view) {
    for (const PolygonId p : ids_of(view.scene)) {
      auto polygon = with_middles(view.scene, p);
      if (grid_bits_for(polygon) == 0) continue;  // twice the largest grid
      const int bits = grid_bits_for(polygon);
      const auto about = points_about(view.scene);
      std::vector<Side> sides;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
        const auto scene = make_scene(data_of(polygon, bits));
        HALFSPACE_LAW(scene.has_value());
        std::vector<Side> now;
        for (const GridPoint& q : about)
          now.push_back(TypeParam::side_of(*scene, 0, q));
        HALFSPACE_LAW(sides.empty() || sides == now);
        sides = now;
        ++accepted;
      }
      // Without the middles it is the polygon itself.
      std::vector<GridPoint> corners;
      for (const VertexId v : view.scene.corners(p))
        corners.push_back(view.scene.point(v));
      HALFSPACE_LAW(
          make_scene(data_of(corners, view.scene.grid_bits())).has_value());
    }
  });
  EXPECT_GT(accepted, 1000u);
}

/// A way to spoil a valid scene at one polygon.
struct Fault {
  ErrorCode code;
  /// Spoils the polygon whose corners are first to end; the index that the
  /// error must have, or nothing if this polygon cannot be spoilt so.
  std::function<std::optional<std::int64_t>(SceneData&, std::size_t)> spoil;
};

/// Puts these points in place of the polygon's corners.
void replace(SceneData& data, std::size_t polygon,
             const std::vector<GridPoint>& points) {
  const std::size_t first = data.first_corner[polygon];
  const std::size_t end = data.first_corner[polygon + 1];
  const auto at = [&](std::size_t k) {
    return data.corners.begin() + static_cast<std::ptrdiff_t>(k);
  };
  std::vector<VertexId> ids;
  for (const GridPoint& p : points) {
    ids.push_back(static_cast<VertexId>(data.vertices.size()));
    data.vertices.push_back(p);
  }
  data.corners.erase(at(first), at(end));
  data.corners.insert(at(first), ids.begin(), ids.end());
  for (std::size_t k = polygon + 1; k < data.first_corner.size(); ++k) {
    data.first_corner[k] = static_cast<std::uint32_t>(
        data.first_corner[k] + points.size() - (end - first));
  }
  data.corner_colors.clear();
}

std::vector<Fault> faults() {
  const auto put = [](std::vector<GridPoint> points) {
    return [points](SceneData& data, std::size_t polygon) {
      replace(data, polygon, points);
      return std::optional(static_cast<std::int64_t>(polygon));
    };
  };
  return {
      {ErrorCode::kTooFewVertices, put({{0, 0, 0}, {1, 0, 0}})},
      {ErrorCode::kTooFewVertices, put({})},
      {ErrorCode::kRepeatedVertex,
       put({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {4, 0, 0}})},
      {ErrorCode::kRepeatedVertex, put({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}})},
      {ErrorCode::kZeroArea, put({{0, 0, 0}, {2, 4, 6}, {1, 2, 3}})},
      {ErrorCode::kNotPlanar,
       put({{0, 0, 0}, {4, 0, 0}, {4, 4, 1}, {0, 4, 0}})},
      {ErrorCode::kNotConvex,
       put({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}})},
      {ErrorCode::kNotConvex,
       put({{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 4, 0}})},
      {ErrorCode::kNotConvex,
       put({{0, 10, 0}, {-6, -8, 0}, {10, 3, 0}, {-10, 3, 0}, {6, -8, 0}})},
      {ErrorCode::kBadIndex,
       [](SceneData& data, std::size_t polygon) {
         data.corners[data.first_corner[polygon]] =
             static_cast<VertexId>(data.vertices.size());
         return std::optional(static_cast<std::int64_t>(polygon));
       }},
      {ErrorCode::kBadIndex,
       [](SceneData& data, std::size_t polygon) {
         data.corners[data.first_corner[polygon + 1] - 1] = -1;
         return std::optional(static_cast<std::int64_t>(polygon));
       }},
      {ErrorCode::kOutOfRange,
       [](SceneData& data, std::size_t polygon) {
         const VertexId vertex = data.corners[data.first_corner[polygon]];
         data.vertices[static_cast<std::size_t>(vertex)].z =
             std::int64_t{1} << (data.grid_bits - 1);
         return std::optional(static_cast<std::int64_t>(vertex));
       }},
      {ErrorCode::kNotTriangle,
       [](SceneData& data, std::size_t polygon) -> std::optional<std::int64_t> {
         data.corner_colors.assign(data.corners.size(), {5, 5, 5});
         const std::size_t first = data.first_corner[polygon];
         if (data.first_corner[polygon + 1] - first <= 3) return {};
         data.corner_colors[first + 3] = {5, 6, 5};
         return static_cast<std::int64_t>(polygon);
       }},
  };
}

TYPED_TEST(S1Geometry, L5APlantedFaultIsToldByCodeAndIndex) {
  std::vector<int> told(faults().size(), 0);
  law::for_all_views([&](const SceneFile& view) {
    for (const PolygonId p : ids_of(view.scene)) {
      const auto all = faults();
      for (std::size_t k = 0; k < all.size(); ++k) {
        SceneData data = view.scene.data();
        const auto index = all[k].spoil(data, static_cast<std::size_t>(p));
        if (!index) continue;
        const auto scene = make_scene(std::move(data));
        HALFSPACE_LAW(!scene);
        HALFSPACE_LAW(scene.error().code == all[k].code);
        HALFSPACE_LAW(scene.error().index == *index);
        HALFSPACE_LAW(!scene.error().message.empty());
        ++told[k];
      }
    }
  });
  for (std::size_t k = 0; k < told.size(); ++k) EXPECT_GT(told[k], 20) << k;
}

TYPED_TEST(S1Geometry, L6AtTheCornersOfAGridOneStepIsTold) {
  std::size_t on = 0, off = 0;
  for (const int bits : kGridBits) {
    const std::int64_t ends[2] = {-(std::int64_t{1} << (bits - 1)),
                                  (std::int64_t{1} << (bits - 1)) - 1};
    const auto corner = [&](int k) {
      return GridPoint{ends[k & 1], ends[k >> 1 & 1], ends[k >> 2]};
    };
    for (int a = 0; a < 8; ++a) {
      for (int b = 0; b < 8; ++b) {
        for (int c = 0; c < 8; ++c) {
          if (a == b || b == c || a == c) continue;
          const auto scene =
              make_scene(data_of({corner(a), corner(b), corner(c)}, bits));
          ASSERT_TRUE(scene.has_value());
          const auto plane = definition::plane_of(*scene, 0);
          std::vector<GridPoint> points = points_about(*scene);
          for (int d = 0; d < 8; ++d) points.push_back(corner(d));
          for (const GridPoint& point : points) {
            const int side =
                definition::side_of(plane, definition::to_point(point));
            EXPECT_EQ(TypeParam::side_of(*scene, 0, point), side_of_sign(side));
            ++(side == 0 ? on : off);
          }
        }
      }
    }
  }
  EXPECT_GT(on, 1000u);
  EXPECT_GT(off, 1000u);
}

TYPED_TEST(S1Geometry, L7TheGridFoundIsTheSmallestThatHoldsAll) {
  law::Cases met({"26", "40", "54", "none"});
  law::check(500, [&] {
    const auto shift = *rc::gen::resize(100, rc::gen::inRange(20, 62));
    const auto sign = *rc::gen::resize(100, rc::gen::inRange(0, 2));
    const auto small = *rc::gen::resize(100, rc::gen::inRange(-2, 3));
    const auto axis = *rc::gen::resize(100, rc::gen::inRange(0, 3));
    const std::int64_t large = (std::int64_t{1} << shift) + small;
    const std::int64_t value = sign == 0 ? large : -large;
    const std::vector<GridPoint> points = {
        {0, 3, -1},
        {axis == 0 ? value : 0, axis == 1 ? value : 1, axis == 2 ? value : 2}};
    int expected = 0;
    for (const int bits : {54, 40, 26}) {
      const std::int64_t limit = std::int64_t{1} << (bits - 1);
      if (-limit <= value && value <= limit - 1) expected = bits;
    }
    HALFSPACE_LAW(grid_bits_for(points) == expected);
    met.meet(expected == 0 ? "none" : std::to_string(expected));
  });
  // At the very limits.
  for (const int bits : kGridBits) {
    const std::int64_t limit = std::int64_t{1} << (bits - 1);
    const int next = bits == 26 ? 40 : bits == 40 ? 54 : 0;
    EXPECT_EQ(grid_bits_for(std::vector<GridPoint>{{0, limit - 1, 0}}), bits);
    EXPECT_EQ(grid_bits_for(std::vector<GridPoint>{{0, 0, -limit}}), bits);
    EXPECT_EQ(grid_bits_for(std::vector<GridPoint>{{limit, 0, 0}}), next);
    EXPECT_EQ(grid_bits_for(std::vector<GridPoint>{{0, -limit - 1, 0}}), next);
  }
  met.expect_all();
}

TYPED_TEST(S1Geometry, L8AWrittenSceneFileReadsBackTheSame) {
  law::for_all_views([](const SceneFile& view) {
    SceneFile file = view;
    file.options.background = {9, 0, 255};
    for (const bool has_camera : {true, false}) {
      if (!has_camera) file.camera.reset();
      const auto read = read_scene(write_scene(file));
      HALFSPACE_LAW(read.has_value());
      HALFSPACE_LAW(*read == file);
    }
  });
}

}  // namespace
}  // namespace halfspace
