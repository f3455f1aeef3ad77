#include "halfspace/ref/boolean.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "small_stack.hpp"
#include "walls.hpp"

namespace halfspace::ref {
namespace {

using enum BooleanOp;
using enum SolidClass;

/// The six faces of a box, facing outwards.
Polygons box(GridPoint p, GridPoint q) {
  return {{{p.x, p.y, p.z}, {p.x, p.y, q.z}, {p.x, q.y, q.z}, {p.x, q.y, p.z}},
          {{q.x, p.y, p.z}, {q.x, q.y, p.z}, {q.x, q.y, q.z}, {q.x, p.y, q.z}},
          {{p.x, p.y, p.z}, {q.x, p.y, p.z}, {q.x, p.y, q.z}, {p.x, p.y, q.z}},
          {{p.x, q.y, p.z}, {p.x, q.y, q.z}, {q.x, q.y, q.z}, {q.x, q.y, p.z}},
          {{p.x, p.y, p.z}, {p.x, q.y, p.z}, {q.x, q.y, p.z}, {q.x, p.y, p.z}},
          {{p.x, p.y, q.z}, {q.x, p.y, q.z}, {q.x, q.y, q.z}, {p.x, q.y, q.z}}};
}

/// The four faces of a tetrahedron, facing outwards.
/// Requires: (q - p), (r - p), (s - p) are right-handed.
Polygons tetrahedron(GridPoint p, GridPoint q, GridPoint r, GridPoint s) {
  return {{p, r, q}, {p, q, s}, {q, r, s}, {r, p, s}};
}

Solid solid_of(const Polygons& polygons) {
  const Result<GridSolid> solid = make_solid(scene_of(polygons));
  HALFSPACE_ASSERT(solid.has_value());
  return to_solid(*solid);
}

Solid cube(int first, int last) {
  return solid_of(box({first, first, first}, {last, last, last}));
}

/// Two boxes that touch along an edge alone; in the plane x = 4 one face of
/// each, facing opposite ways.
Solid two_boxes() {
  Polygons polygons = box({0, 0, 0}, {4, 4, 4});
  for (const auto& polygon : box({4, 4, 0}, {8, 8, 4})) {
    polygons.push_back(polygon);
  }
  return solid_of(polygons);
}

TEST(Faces, AreNamedByThemselvesAndTheirOwnEdges) {
  const Solid solid = cube(0, 4);
  ASSERT_EQ(solid.faces.size(), 6u);
  for (PolygonId id = 0; id < 6; ++id) {
    const Face& face = solid.faces[static_cast<std::size_t>(id)];
    EXPECT_TRUE(face.from_first);
    EXPECT_EQ(face.source, id);
    const Fragment fragment = whole(solid, id);
    EXPECT_EQ(fragment.source, id);
    ASSERT_EQ(fragment.vertices.size(), 4u);
    ASSERT_EQ(fragment.edges.size(), 4u);
    for (std::int32_t k = 0; k < 4; ++k) {
      const EdgeName expected{EdgeName::Kind::kSource, k};
      EXPECT_EQ(fragment.edges[static_cast<std::size_t>(k)], expected);
    }
  }
}

Rational area_x(const std::vector<Point>& vertices) {
  return plane_of(vertices).a;  // of a parallelogram
}

std::vector<BuildOptions> many_trees() {
  std::vector<BuildOptions> all;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    all.push_back({.rule = RootRule::kRandom, .candidates = 1, .seed = seed});
  }
  for (const RootRule rule : {RootRule::kFirst, RootRule::kH2, RootRule::kH4}) {
    all.push_back({.rule = rule});
  }
  return all;
}

TEST(Keep, IsTheTableOfThePaper) {
  // Per class: what AND, OR, A - B and XOR take of A and of B.
  const std::pair<SolidClass, std::string_view> rows[] = {
      {kInside, "XX...FFF"},
      {kOutside, "..XXX.XX"},
      {kOpposite, "....X..."},
      {kSame, "X.X....."}};
  const BooleanOp columns[] = {kIntersection, kUnion, kDifference,
                               kSymmetricDifference};
  for (const auto& [solid_class, row] : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Keep expected = row[i] == 'X'   ? Keep::kKeep
                            : row[i] == 'F' ? Keep::kFlip
                                            : Keep::kDrop;
      EXPECT_EQ(keep(columns[i / 2], solid_class, i % 2 == 0), expected)
          << row << " " << i;
    }
  }
}

TEST(Classify, InThePlaneOfFacesOfBothDirections) {
  // E3: whichever face of x = 4 becomes the splitter.
  for (const bool turn : {false, true}) {
    std::vector<GridPoint> wall = {
        {4, -2, -2}, {4, 10, -2}, {4, 10, 6}, {4, -2, 6}};
    if (turn) wall = turned_over(wall);
    const Fragment polygon = whole(scene_of({wall}), 0);
    for (const BuildOptions& options : many_trees()) {
      Rational same = 0, opposite = 0, outside = 0, inside = 0;
      for (const Classified& part :
           classify(build(two_boxes(), options), polygon,
                    plane_of(polygon.vertices))) {
        // Every part is a rectangle here.
        const Rational area = area_x(part.fragment.vertices);
        (part.solid_class == kSame       ? same
         : part.solid_class == kOpposite ? opposite
         : part.solid_class == kInside   ? inside
                                         : outside) += turn ? -area : area;
      }
      EXPECT_EQ((turn ? opposite : same).to_int64(), 16);
      EXPECT_EQ((turn ? same : opposite).to_int64(), 16);
      EXPECT_EQ(inside.to_int64(), 0);
      EXPECT_EQ(outside.to_int64(), 12 * 8 - 32);
    }
  }
}

TEST(Classify, BesideThePlaneOfTheFaces) {
  // x = 2 goes through the first box alone.
  const Fragment polygon =
      whole(scene_of({{{2, -2, -2}, {2, 10, -2}, {2, 10, 6}, {2, -2, 6}}}), 0);
  for (const BuildOptions& options : many_trees()) {
    Rational inside = 0;
    for (const Classified& part : classify(build(two_boxes(), options), polygon,
                                           plane_of(polygon.vertices))) {
      if (part.solid_class == kInside)
        inside += area_x(part.fragment.vertices);
      else
        EXPECT_EQ(part.solid_class, kOutside);
    }
    EXPECT_EQ(inside.to_int64(), 16);
  }
}

TEST(Classify, AChainOf100000NodesNeedsNoDeepStack) {
  on_small_stack([] {
    constexpr std::int32_t kCount = 100000;
    // Past all nodes but the two last, which cut it.
    const Fragment polygon =
        whole(scene_of({wall_z(1, kCount - 3, kCount)}), 0);
    const std::vector<Classified> parts =
        classify(chain(kCount), polygon, plane_of(polygon.vertices));
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[0].solid_class, kOutside);
    EXPECT_EQ(parts[1].solid_class, kInside);
    EXPECT_EQ(parts[2].solid_class, kInside);
  });
}

/// The volumes of the three booleans, in that of a unit cube.
struct Volumes {
  int of_union, of_intersection, of_difference;
};

void expect_volumes(const Solid& a, const Solid& b, const Volumes& expected) {
  const int volumes[] = {expected.of_union, expected.of_intersection,
                         expected.of_difference};
  for (const BuildOptions& options : many_trees()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Solid result = boolean(kBooleanOps[i], a, b, options);
      EXPECT_EQ(volume6(result).to_int64(), 6 * volumes[i]) << i;
      EXPECT_TRUE(bad_edges(result).empty()) << i;
      EXPECT_EQ(result.faces.empty(), volumes[i] == 0) << i;
    }
  }
}

TEST(Boolean, BoxesInEveryPosition) {
  const Solid a = cube(0, 4);
  expect_volumes(a, cube(1, 5), {64 + 64 - 27, 27, 37});
  expect_volumes(a, cube(1, 3), {64, 8, 56});  // nested
  expect_volumes(cube(1, 3), a, {64, 8, 0});
  expect_volumes(a, cube(5, 6), {65, 0, 64});  // apart
  expect_volumes(a, a, {64, 64, 0});
  // Coplanar faces, of one direction, and of both.
  expect_volumes(a, solid_of(box({2, 0, 0}, {6, 4, 4})), {96, 32, 32});
  expect_volumes(a, solid_of(box({0, 0, 0}, {4, 4, 2})), {64, 32, 32});
  expect_volumes(a, solid_of(box({4, 0, 0}, {8, 4, 4})), {128, 0, 64});
  expect_volumes(a, solid_of(box({4, 1, 1}, {8, 6, 2})), {84, 0, 64});
  expect_volumes(a, solid_of(box({4, 4, 1}, {8, 6, 2})), {72, 0, 64});  // edge
  expect_volumes(a, cube(4, 5), {65, 0, 64});  // corner
  // A hole right through, flush with two faces.
  expect_volumes(a, solid_of(box({1, 1, 0}, {3, 3, 4})), {64, 16, 48});
  expect_volumes(a, two_boxes(), {128, 64, 0});
  expect_volumes(two_boxes(), solid_of(box({0, 4, 0}, {4, 8, 4})),
                 {192, 0, 128});
}

TEST(Boolean, WhereTwoBoxesTouchNothingIsLeftInside) {
  const Solid a = cube(0, 4);
  const Solid b = solid_of(box({4, 0, 0}, {8, 4, 4}));
  for (const Face& face : boolean(kUnion, a, b).faces) {
    EXPECT_FALSE(side_of(face.plane, {4, 2, 2}) == Side::kOn);
  }
}

TEST(Boolean, TheEmptySolidIsAnOperandAndAResult) {
  const Solid a = cube(0, 4);
  const Solid empty;
  expect_volumes(a, empty, {64, 0, 64});
  expect_volumes(empty, a, {64, 0, 0});
  expect_volumes(empty, empty, {0, 0, 0});
}

TEST(Boolean, VolumesAddUpInAChainOfSlantedCuts) {
  Solid a = solid_of(box({-9, -9, -9}, {9, 9, 9}));
  for (int turn = 0; turn < 5; ++turn) {
    const int t = turn;
    const Solid b =
        solid_of(tetrahedron({-11 + t, -7, 3 - 2 * t}, {13, -5 + t, 2},
                             {1 - t, 12, -1 + t}, {3, 1 + 2 * t, 17 - t}));
    const Solid all = boolean(kUnion, a, b);
    const Solid both = boolean(kIntersection, a, b);
    const Solid rest = boolean(kDifference, a, b);
    EXPECT_TRUE(volume6(all) + volume6(both) == volume6(a) + volume6(b));
    EXPECT_TRUE(volume6(rest) + volume6(both) == volume6(a));
    EXPECT_GT(sign(volume6(both)), 0);
    for (const Solid& result : {all, both, rest}) {
      EXPECT_TRUE(bad_edges(result).empty());
    }
    // Planes are never computed again, so their numbers do not grow.
    for (const Face& face : rest.faces) {
      const Solid& operand = face.from_first ? a : b;
      const Plane& plane =
          operand.faces[static_cast<std::size_t>(face.source)].plane;
      const int direction = face.from_first ? 1 : -1;
      EXPECT_TRUE(face.plane.a == plane.a * direction);
      EXPECT_TRUE(face.plane.b == plane.b * direction);
      EXPECT_TRUE(face.plane.c == plane.c * direction);
      EXPECT_TRUE(face.plane.d == plane.d * direction);
      for (const Point& vertex : face.vertices) {
        EXPECT_EQ(side_of(face.plane, vertex), Side::kOn);
      }
    }
    a = rest;
  }
  EXPECT_FALSE(volume6(a) == floor(volume6(a)));  // true rationals
}

TEST(Boolean, FacesKeepColourAndOrigin) {
  const Solid a = cube(0, 4);
  Solid b = cube(1, 5);
  for (Face& face : b.faces) face.color.g = 99;
  const Solid rest = boolean(kDifference, a, b);
  int from_second = 0;
  for (const Face& face : rest.faces) {
    EXPECT_EQ(face.color.g, face.from_first ? 10 : 99);
    EXPECT_EQ(face.color.r, face.source);  // as scene_of() paints them
    from_second += face.from_first ? 0 : 1;
  }
  EXPECT_EQ(from_second, 3);
}

TEST(BadEdges, AreThoseOfAMissingOrReversedFace) {
  Solid a = cube(0, 4);
  EXPECT_TRUE(bad_edges(a).empty());
  std::reverse(a.faces[5].vertices.begin(), a.faces[5].vertices.end());
  std::vector<BadEdge> bad = bad_edges(a);
  ASSERT_EQ(bad.size(), 4u);
  for (const BadEdge& edge : bad) {
    EXPECT_EQ(edge.excess, 2);
    EXPECT_TRUE(edge.from.z == 4 && edge.to.z == 4);
  }
  a.faces.pop_back();
  bad = bad_edges(a);
  ASSERT_EQ(bad.size(), 4u);
  EXPECT_EQ(bad[0].excess, 1);
  // The face x = 0 runs up its edge from (0, 0, 4) to (0, 4, 4).
  EXPECT_EQ(bad[0].from, (Point{0, 0, 4}));
  EXPECT_EQ(bad[0].to, (Point{0, 4, 4}));
}

TEST(Rounded, CoordinatesAreTheNearestDoublesInModelUnits) {
  const Solid a = cube(0, 3);
  const RoundedSolid tenths = rounded(a, {.base = 10, .exponent = -1});
  EXPECT_EQ(tenths.vertices.size(), 8u);
  EXPECT_EQ(tenths.first_corner.size(), 7u);
  EXPECT_EQ(tenths.first_corner.back(), tenths.corners.size());
  ASSERT_EQ(tenths.corners.size(), 24u);
  EXPECT_EQ(tenths.colors.size(), 6u);
  for (std::size_t i = 0; i < tenths.corners.size(); ++i) {
    const Point& p = a.faces[i / 4].vertices[i % 4];
    const auto& q =
        tenths.vertices[static_cast<std::size_t>(tenths.corners[i])];
    EXPECT_EQ(q[0], sign(p.x) == 0 ? 0 : 0.3);
    EXPECT_EQ(q[1], sign(p.y) == 0 ? 0 : 0.3);
    EXPECT_EQ(q[2], sign(p.z) == 0 ? 0 : 0.3);
  }
  // Four vertices have each coordinate 3/10, which is no double.
  EXPECT_EQ(tenths.moved, 12u);
  EXPECT_EQ(tenths.max_move,
            nearest_double(Rational(3) / 10 - Rational(BigRational(0.3))));

  // Among 3/10, 7/10 and 1/10 the second is farthest from a double.
  const Solid b = solid_of(box({0, 0, 0}, {3, 7, 1}));
  EXPECT_EQ(rounded(b, {.base = 10, .exponent = -1}).max_move,
            nearest_double(Rational(7) / 10 - Rational(BigRational(0.7))));

  const RoundedSolid halves = rounded(a, {.base = 2, .exponent = -1});
  EXPECT_EQ(halves.moved, 0u);
  EXPECT_EQ(halves.max_move, 0);
  for (const auto& [unit, three] :
       {std::pair(Unit{10, 2}, 300.0), std::pair(Unit{10, 0}, 3.0)}) {
    const RoundedSolid whole_numbers = rounded(a, unit);
    EXPECT_EQ(whole_numbers.moved, 0u);
    int threes = 0;
    for (const auto& vertex : whole_numbers.vertices) {
      for (const double c : vertex) {
        EXPECT_TRUE(c == 0 || c == three) << c;
        threes += c == three;
      }
    }
    EXPECT_EQ(threes, 12);
  }
  const RoundedSolid huge = rounded(a, {.base = 10, .exponent = 400});
  EXPECT_TRUE(std::isinf(huge.max_move));
  EXPECT_EQ(huge.moved, 12u);
}

}  // namespace
}  // namespace halfspace::ref
