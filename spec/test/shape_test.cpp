// Shapes of polygons against S1.3 read word by word: every polygon on a small
// lattice, laid at the ends of every grid.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/scene.hpp"
#include "planes.hpp"

namespace halfspace {
namespace {

using Points = std::vector<GridPoint>;

struct Vector {
  std::int64_t x, y, z;
};

Vector difference(const GridPoint& p, const GridPoint& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}

Vector cross(const Vector& u, const Vector& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

std::int64_t dot(const Vector& u, const Vector& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

/// The error that S1.3 gives a polygon of small coordinates. Convex is here:
/// no point is on the wrong side of any edge, for one of both turns. Then every
/// edge is part of the hull's boundary, and going round it twice visits the
/// hull's corners twice.
std::optional<ErrorCode> error_of(const Points& points) {
  if (points.size() < 3) return ErrorCode::kTooFewVertices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (points[i] == points[j]) return ErrorCode::kRepeatedVertex;
    }
  }
  // All on one line if every one is on that of the first two.
  Vector normal{};
  for (const GridPoint& p : points) {
    const Vector n =
        cross(difference(points[1], points[0]), difference(p, points[0]));
    if (dot(n, n) != 0) normal = n;
  }
  if (dot(normal, normal) == 0) return ErrorCode::kZeroArea;
  bool wrong_left = false, wrong_right = false;
  for (const GridPoint& p : points) {
    if (dot(normal, difference(p, points[0])) != 0) {
      return ErrorCode::kNotPlanar;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const GridPoint& from = points[i];
      const GridPoint& to = points[(i + 1) % points.size()];
      const std::int64_t side =
          dot(normal, cross(difference(to, from), difference(p, from)));
      wrong_left = wrong_left || side < 0;
      wrong_right = wrong_right || side > 0;
    }
  }
  if (wrong_left && wrong_right) return ErrorCode::kNotConvex;
  return std::nullopt;
}

/// The error that make_scene() gives the polygon, scaled; it must name it.
std::optional<ErrorCode> error_of_scene(const Points& points, int grid_bits,
                                        std::int64_t scale) {
  SceneData data;
  data.grid_bits = grid_bits;
  for (const GridPoint& p : points) {
    data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
    data.vertices.push_back({p.x * scale, p.y * scale, p.z * scale});
  }
  data.first_corner.push_back(static_cast<std::uint32_t>(points.size()));
  data.colors.push_back({});
  const Result<Scene> scene = make_scene(std::move(data));
  if (scene) return std::nullopt;
  EXPECT_EQ(scene.error().index, 0);
  return scene.error().code;
}

/// Calls visit with every sequence of `count` of the points whose first is one
/// of `firsts`.
template <class Visit>
void for_sequences(const Points& points, const Points& firsts,
                   std::size_t count, Visit&& visit) {
  Points chosen(count);
  std::vector<std::size_t> at(count, 0);
  while (true) {
    chosen[0] = firsts[at[0]];
    for (std::size_t i = 1; i < count; ++i) chosen[i] = points[at[i]];
    visit(chosen);
    std::size_t i = 0;
    while (i < count && ++at[i] == (i == 0 ? firsts : points).size()) {
      at[i++] = 0;
    }
    if (i == count) return;
  }
}

/// How often each verdict was given.
struct Verdicts {
  int fine = 0, repeated = 0, flat = 0, bent = 0, dented = 0;

  void look_at(const Points& points, int bits, std::int64_t scale) {
    const std::optional<ErrorCode> error = error_of(points);
    ASSERT_EQ(error_of_scene(points, bits, scale), error);
    fine += !error ? 1 : 0;
    repeated += error == ErrorCode::kRepeatedVertex ? 1 : 0;
    flat += error == ErrorCode::kZeroArea ? 1 : 0;
    bent += error == ErrorCode::kNotPlanar ? 1 : 0;
    dented += error == ErrorCode::kNotConvex ? 1 : 0;
  }
};

std::int64_t greatest(int bits) { return (std::int64_t{1} << (bits - 1)) - 1; }

TEST(Shape, IsThatOfEveryPolygonOnASquareOfNinePointsInSpace) {
  Verdicts verdicts;
  for (int plane = 0; plane < 6; ++plane) {
    Points points;
    for (const std::int64_t u : {-1, 0, 1}) {
      for (const std::int64_t v : {-1, 0, 1}) {
        points.push_back(in_plane(plane, u, v));
      }
    }
    // The square's symmetries take every first corner to one of these.
    const Points firsts = {points[0], points[1], points[4]};
    for (const int bits : kGridBits) {
      for (const std::size_t count : {3u, 4u}) {
        for_sequences(points, firsts, count, [&](const Points& chosen) {
          verdicts.look_at(chosen, bits, greatest(bits));
        });
        ASSERT_FALSE(HasFailure());
      }
    }
    const int bits = kGridBits[static_cast<std::size_t>(plane % 3)];
    for_sequences(points, firsts, 5, [&](const Points& chosen) {
      verdicts.look_at(chosen, bits, greatest(bits));
    });
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(verdicts.fine, 5000);
  EXPECT_GT(verdicts.repeated, 10000);
  EXPECT_GT(verdicts.flat, 300);
  EXPECT_EQ(verdicts.bent, 0);
  EXPECT_GT(verdicts.dented, 5000);
}

TEST(Shape, IsThatOfEveryFourPointsOfACube) {
  Points points;
  for (const std::int64_t x : {-1, 0, 1}) {
    for (const std::int64_t y : {-1, 0, 1}) {
      for (const std::int64_t z : {-1, 0, 1}) points.push_back({x, y, z});
    }
  }
  Verdicts verdicts;
  std::size_t number = 0;
  for_sequences(points, {points[0], points[13]}, 4, [&](const Points& chosen) {
    const int bits = kGridBits[number++ % 3];
    verdicts.look_at(chosen, bits, greatest(bits));
  });
  EXPECT_GT(verdicts.fine, 300);
  EXPECT_GT(verdicts.bent, 10000);
}

TEST(Shape, RefusesEveryStarThatWindsTwiceRoundAHexagon) {
  const Points hexagon = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0},
                          {2, 2, 0}, {1, 2, 0}, {0, 1, 0}};
  Verdicts verdicts;
  for (const int bits : kGridBits) {
    for_sequences(hexagon, hexagon, 5, [&](const Points& chosen) {
      verdicts.look_at(chosen, bits, greatest(bits) / 2);
    });
  }
  // Five of six corners in order, from any one on, either way round.
  EXPECT_EQ(verdicts.fine, 3 * 6 * 5 * 2);
}

TEST(Shape, IsToldByItsMessage) {
  const auto message = [](const Points& points) {
    SceneData data;
    for (const GridPoint& p : points) {
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
      data.vertices.push_back(p);
    }
    data.first_corner.push_back(static_cast<std::uint32_t>(points.size()));
    data.colors.push_back({});
    const Result<Scene> scene = make_scene(std::move(data));
    return scene ? std::string("fine") : scene.error().message;
  };
  EXPECT_EQ(message({{0, 0, 0}, {1, 0, 0}}), "polygon 0 has 2 vertices");
  EXPECT_EQ(message({{0, 0, 0}, {4, 0, 0}, {4, 4, 1}, {0, 4, 0}}),
            "polygon 0 has its corner 3 off its plane");
  EXPECT_EQ(message({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}),
            "polygon 0 is not convex at corner 2");
  EXPECT_EQ(message({{1, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}}),
            "polygon 0 is not convex at corner 0");
  // Straight, but back: at every corner.
  Points spike = {{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 4, 0}};
  for (int corner : {1, 2, 3, 2}) {
    EXPECT_EQ(message(spike),
              "polygon 0 is not convex at corner " + std::to_string(corner));
    std::rotate(spike.begin(), spike.begin() + 1, spike.end());
  }
  EXPECT_EQ(
      message({{0, 10, 0}, {-6, -8, 0}, {10, 3, 0}, {-10, 3, 0}, {6, -8, 0}}),
      "polygon 0 winds round more than once");
  // Back beyond where its edge began.
  EXPECT_EQ(message({{0, 0, 0}, {4, 0, 0}, {-2, 0, 0}, {-2, 4, 0}}),
            "polygon 0 is not convex at corner 1");
  // The first corner that is not straight tells which way the others turn.
  EXPECT_EQ(message({{4, 0, 0}, {1, 1, 0}, {0, 4, 0}, {0, 0, 0}}),
            "polygon 0 is not convex at corner 2");
}

}  // namespace
}  // namespace halfspace
