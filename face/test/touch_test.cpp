#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include "halfspace/halfspace.hpp"

namespace halfspace {
namespace {

using Cell = std::array<std::int64_t, 3>;

/// What two solids have in common.
struct Common {
  bool overlap = false;   ///< points of both interiors
  bool touch = false;     ///< points of both, closed
  bool contains = false;  ///< all of the second one
  friend bool operator==(const Common&, const Common&) = default;
};

Common asked(const Solid& a, const Solid& b) {
  EXPECT_TRUE(a.touches(b)) << a.touches(b).error().message;
  return {*a.overlaps(b), *a.touches(b), *a.contains(b)};
}

class TouchDraws {
 public:
  explicit TouchDraws(std::uint64_t seed) : random_(seed) {}
  std::int64_t below(std::int64_t bound) {
    return static_cast<std::int64_t>(random_() %
                                     static_cast<std::uint64_t>(bound));
  }
  std::vector<Cell> cells() {
    std::vector<Cell> result;
    for (std::int64_t i = 0; i < 27; ++i) {
      if (below(6) == 0) result.push_back({i % 3, i / 3 % 3, i / 9});
    }
    if (result.empty()) result.push_back({below(3), below(3), below(3)});
    return result;
  }
  std::vector<Cell> points() {
    std::vector<Cell> result;
    for (std::int64_t i = 4 + below(3); i > 0; --i)
      result.push_back({below(6), below(6), below(6)});
    return result;
  }
  Cell shift(std::int64_t most) {
    return {below(2 * most + 1) - most, below(2 * most + 1) - most,
            below(2 * most + 1) - most};
  }

 private:
  std::mt19937_64 random_;
};

Point point_of(const Cell& c) {
  return {static_cast<double>(c[0]), static_cast<double>(c[1]),
          static_cast<double>(c[2])};
}

Cell sum(const Cell& a, const Cell& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Cell difference(const Cell& a, const Cell& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Unit cubes with these corners, each of `size` a side.
Solid solid_of(const std::vector<Cell>& cells, double size) {
  std::vector<Solid> cubes;
  for (const Cell& c : cells) {
    const Point low = point_of(c), high = point_of(sum(c, {1, 1, 1}));
    cubes.push_back(Solid::box({size * low.x, size * low.y, size * low.z},
                               {size * high.x, size * high.y, size * high.z}));
  }
  return Solid::union_of(cubes);
}

/// Closed cells have a point in common if no index differs by more than 1.
Common of_cells(const std::vector<Cell>& a, const std::vector<Cell>& b) {
  Common result;
  for (const Cell& c : a) {
    for (const Cell& d : b) {
      std::int64_t most = 0;
      for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most, std::abs(c[k] - d[k]));
      result.overlap = result.overlap || most == 0;
      result.touch = result.touch || most <= 1;
    }
  }
  result.contains = std::all_of(b.begin(), b.end(), [&](const Cell& d) {
    return std::find(a.begin(), a.end(), d) != a.end();
  });
  return result;
}

std::int64_t dot(const Cell& a, const Cell& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Cell cross(const Cell& a, const Cell& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

/// Normals of all planes through three of the points, those of the hull's faces
/// among them.
std::vector<Cell> normals_of(const std::vector<Cell>& points) {
  std::vector<Cell> normals;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k)
        normals.push_back(cross(difference(points[j], points[i]),
                                difference(points[k], points[i])));
    }
  }
  return normals;
}

struct Extent {
  std::int64_t low;
  std::int64_t high;
};

Extent extent_of(const std::vector<Cell>& points, const Cell& axis) {
  Extent extent{dot(points[0], axis), dot(points[0], axis)};
  for (const Cell& p : points) {
    extent.low = std::min(extent.low, dot(p, axis));
    extent.high = std::max(extent.high, dot(p, axis));
  }
  return extent;
}

/// Two convex hulls are apart if the normal of a face of either, or the product
/// of an edge of each, parts them: in integers.
Common of_hulls(const std::vector<Cell>& a, const std::vector<Cell>& b) {
  std::vector<Cell> axes = normals_of(a);
  const std::vector<Cell> own = axes, others = normals_of(b);
  axes.insert(axes.end(), others.begin(), others.end());
  for (const Cell& p : a) {
    for (const Cell& q : a) {
      for (const Cell& r : b) {
        for (const Cell& s : b)
          axes.push_back(cross(difference(p, q), difference(r, s)));
      }
    }
  }
  Common result{true, true, true};
  for (const Cell& axis : axes) {
    if (axis == Cell{}) continue;
    const Extent of_a = extent_of(a, axis), of_b = extent_of(b, axis);
    if (of_a.high <= of_b.low || of_b.high <= of_a.low) result.overlap = false;
    if (of_a.high < of_b.low || of_b.high < of_a.low) result.touch = false;
  }
  for (const Cell& axis : own) {
    const Extent of_a = extent_of(a, axis), of_b = extent_of(b, axis);
    if (of_b.low < of_a.low || of_b.high > of_a.high) result.contains = false;
  }
  return result;
}

/// How often each kind of answer came up: all have to.
struct Tally {
  int apart = 0, touching = 0, overlapping = 0, held = 0;
  void add(const Common& common) {
    ++(common.contains  ? held
       : common.overlap ? overlapping
       : common.touch   ? touching
                        : apart);
  }
};

TEST(FaceTouch, SolidsOfCellsHaveInCommonWhatTheirCellsHave) {
  TouchDraws draws(31);
  Tally tally;
  // Slanted, and as they are: the map takes lattices to lattices.
  const AffineMap slant = {{{1, 2, 0, 0.5}, {0, 1, 0, -3}, {1, 0, 1, 0.25}}};
  for (int round = 0; round < 300; ++round) {
    std::vector<Cell> a = draws.cells(), b = draws.cells();
    // Now and then a part of the first, and of other units all.
    if (draws.below(5) == 0)
      b = {a[static_cast<std::size_t>(
          draws.below(static_cast<std::int64_t>(a.size())))]};
    else
      for (const Cell by = draws.shift(3); Cell & c : b) c = sum(c, by);
    const bool is_decimal = draws.below(2) == 0;
    Solid first = solid_of(a, 1);
    Solid second =
        is_decimal ? solid_of(b, 10).scaled(0.1) : solid_of(b, 4).scaled(0.25);
    if (draws.below(2) == 0) {
      first = first.transformed(slant);
      second = second.transformed(slant);
    }
    const Common common = of_cells(a, b);
    ASSERT_EQ(asked(first, second), common) << round;
    tally.add(common);
  }
  EXPECT_GT(
      std::min({tally.apart, tally.touching, tally.overlapping, tally.held}),
      10);
}

TEST(FaceTouch, HullsHaveInCommonWhatNoPlaneParts) {
  TouchDraws draws(32);
  Tally tally;
  int tried = 0;
  while (tried < 400) {
    const std::vector<Cell> a = draws.points();
    std::vector<Cell> b = draws.points();
    const Cell by = draws.shift(5);
    const bool is_within = draws.below(4) == 0;
    // Now and then within the first: of its corners.
    for (Cell& c : b) {
      c = is_within ? a[static_cast<std::size_t>(
                          draws.below(static_cast<std::int64_t>(a.size())))]
                    : sum(c, by);
    }
    std::vector<Point> a_points, b_points;
    for (const Cell& c : a) a_points.push_back(point_of(c));
    for (const Cell& c : b) b_points.push_back(point_of(c));
    const Solid first = Solid::hull(a_points), second = Solid::hull(b_points);
    if (!first.evaluate() || !second.evaluate()) continue;  // flat
    ++tried;
    const Common common = of_hulls(a, b);
    ASSERT_EQ(asked(first, second), common) << tried;
    ASSERT_EQ(*second.touches(first), common.touch) << tried;
    tally.add(common);
  }
  EXPECT_GT(
      std::min({tally.apart, tally.touching, tally.overlapping, tally.held}),
      10);
}

TEST(FaceTouch, EdgesMeetWithinEdgesAndFacesWithoutACorner) {
  const Solid bar = Solid::box({-5, -1, -1}, {5, 1, 1});
  const auto touch = [&bar](const Solid& other) {
    EXPECT_EQ(*bar.touches(other), *other.touches(bar));
    EXPECT_FALSE(*bar.overlaps(other));
    return *bar.touches(other);
  };
  // Across on top of it: no corner of one is in the other.
  const Solid across = Solid::box({-1, -5, 1}, {1, 5, 3});
  EXPECT_TRUE(touch(across));
  EXPECT_FALSE(touch(across.translated({0, 0, 1. / 1024})));
  // Edge across edge in one point.
  const Solid edge = Solid::hull(std::vector<Point>{
      {0, -4, 2}, {0, 6, 0}, {1, -4, 4}, {1, 6, 2}, {-1, -4, 4}, {-1, 6, 2}});
  EXPECT_TRUE(touch(edge));
  EXPECT_FALSE(touch(edge.translated({0, 0, 1. / 1024})));
  // Part of an edge is part of another one.
  EXPECT_TRUE(touch(Solid::box({3, 1, 1}, {9, 2, 2})));
  EXPECT_TRUE(touch(Solid::box({-3, 1, 1}, {3, 2, 2})));
  EXPECT_FALSE(touch(Solid::box({5.0009765625, 1, 1}, {9, 2, 2})));
}

TEST(FaceTouch, HalfSpacesAreAskedForWhatBooleansTell) {
  const Solid half = Solid::half_space({{1, 2, 2}, 3});
  const auto cube = [](double x) {
    return Solid::box({x, 0, 0}, {x + 1, 1, 1});
  };
  EXPECT_TRUE(*half.contains(cube(-2)));
  EXPECT_FALSE(*half.contains(cube(-1.875)));
  EXPECT_TRUE(*half.overlaps(cube(2.875)));
  EXPECT_TRUE(*half.touches(cube(2.875)));
  EXPECT_FALSE(*half.overlaps(cube(3)));
  // It has no surface of its own to be touched.
  EXPECT_EQ(half.touches(cube(3)).error().code, ErrorCode::kUnbounded);
  EXPECT_EQ(cube(3).touches(half).error().code, ErrorCode::kUnbounded);
}

TEST(FaceTouch, ManyFacesNearEachOtherAreNotAllCompared) {
  // Spheres of 65,536 faces with a gap that is narrower than a face: of all
  // pairs of faces, 4 milliard, only those near the gap are looked at.
  const Solid ball = Solid::sphere(1, 256);
  ASSERT_TRUE(ball.evaluate());
  EXPECT_EQ(asked(ball, ball.translated({2.0001, 0, 0})), Common{});
  EXPECT_EQ(asked(ball, ball.translated({2, 0, 0})),
            (Common{false, true, false}));
}

}  // namespace
}  // namespace halfspace
