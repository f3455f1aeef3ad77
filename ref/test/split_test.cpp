#include "halfspace/ref/split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "scenes.hpp"

namespace halfspace::ref {
namespace {

using enum EdgeName::Kind;

constexpr PolygonId kSplitterId = 7;

/// The plane a x + b y + c z + d.
Plane plane(int a, int b, int c, int d) { return {a, b, c, d}; }

Fragment fragment_of(const std::vector<GridPoint>& corners) {
  return whole(scene_of({corners}), 0);
}

/// A square in the plane z = 5, seen counter-clockwise from above.
Fragment square() {
  return fragment_of({{0, 0, 5}, {4, 0, 5}, {4, 4, 5}, {0, 4, 5}});
}

std::vector<Point> points(
    const std::vector<std::pair<Rational, Rational>>& coordinates) {
  std::vector<Point> result;
  for (const auto& [x, y] : coordinates) result.push_back({x, y, 5});
  return result;
}

TEST(Predicate, RelationIsByTheSignsAtTheVertices) {
  EXPECT_EQ(relation(square(), plane(1, 0, 0, 1)), Relation::kPositive);
  EXPECT_EQ(relation(square(), plane(1, 0, 0, 0)), Relation::kPositive);
  EXPECT_EQ(relation(square(), plane(1, 0, 0, -1)), Relation::kSpanning);
  EXPECT_EQ(relation(square(), plane(1, 0, 0, -4)), Relation::kNegative);
  EXPECT_EQ(relation(square(), plane(-1, 0, 0, 0)), Relation::kNegative);
  EXPECT_EQ(relation(square(), plane(0, 0, 1, -5)), Relation::kCoincident);
  EXPECT_EQ(relation(square(), plane(0, 0, -3, 15)), Relation::kCoincident);
}

TEST(Predicate, ThePlaneOfAPolygonSkipsStraightCorners) {
  const Fragment straight =
      fragment_of({{0, 0, 5}, {1, 0, 5}, {4, 0, 5}, {4, 4, 5}, {0, 4, 5}});
  const Plane found = plane_of(straight.vertices);
  EXPECT_TRUE(sign(found.a) == 0 && sign(found.b) == 0);
  EXPECT_GT(sign(found.c), 0);
  EXPECT_TRUE(found.d == found.c * -5);
}

TEST(Split, AcrossTwoEdgesBothPartsGetTwoNewVertices) {
  // x = 1 cuts edges 0 (y = 0) and 2 (y = 4).
  const auto [positive, negative] =
      split(square(), plane(2, 0, 0, -2), kSplitterId);
  EXPECT_EQ(positive.source, 0);
  EXPECT_EQ(negative.source, 0);
  EXPECT_EQ(positive.vertices, points({{1, 0}, {4, 0}, {4, 4}, {1, 4}}));
  EXPECT_EQ(positive.edges,
            (std::vector<EdgeName>{
                {kSource, 0}, {kSource, 1}, {kSource, 2}, {kSplitter, 7}}));
  EXPECT_EQ(negative.vertices, points({{0, 0}, {1, 0}, {1, 4}, {0, 4}}));
  EXPECT_EQ(negative.edges,
            (std::vector<EdgeName>{
                {kSource, 0}, {kSplitter, 7}, {kSource, 2}, {kSource, 3}}));
}

TEST(Split, ThroughAVertexUsesThatVertex) {
  // From (0, 0) to (4, 2): vertex 0, and edge 1 in its middle.
  const auto [positive, negative] =
      split(square(), plane(1, -2, 0, 0), kSplitterId);
  EXPECT_EQ(positive.vertices, points({{0, 0}, {4, 0}, {4, 2}}));
  EXPECT_EQ(positive.edges, (std::vector<EdgeName>{
                                {kSource, 0}, {kSource, 1}, {kSplitter, 7}}));
  EXPECT_EQ(negative.vertices, points({{0, 0}, {4, 2}, {4, 4}, {0, 4}}));
  EXPECT_EQ(negative.edges,
            (std::vector<EdgeName>{
                {kSplitter, 7}, {kSource, 1}, {kSource, 2}, {kSource, 3}}));
}

TEST(Split, AlongADiagonalGivesTwoTriangles) {
  const auto [positive, negative] =
      split(square(), plane(-1, 1, 0, 0), kSplitterId);
  EXPECT_EQ(positive.vertices, points({{0, 0}, {4, 4}, {0, 4}}));
  EXPECT_EQ(positive.edges, (std::vector<EdgeName>{
                                {kSplitter, 7}, {kSource, 2}, {kSource, 3}}));
  EXPECT_EQ(negative.vertices, points({{0, 0}, {4, 0}, {4, 4}}));
  EXPECT_EQ(negative.edges, (std::vector<EdgeName>{
                                {kSource, 0}, {kSource, 1}, {kSplitter, 7}}));
}

TEST(Split, NewVerticesAreExact) {
  // 3 x + 7 y = 10: (10/3, 0) and (0, 10/7).
  const auto [positive, negative] =
      split(square(), plane(3, 7, 0, -10), kSplitterId);
  const Rational x = Rational(10) / 3;
  const Rational y = Rational(10) / 7;
  EXPECT_EQ(positive.vertices,
            points({{x, 0}, {4, 0}, {4, 4}, {0, 4}, {0, y}}));
  EXPECT_EQ(negative.vertices, points({{0, 0}, {x, 0}, {0, y}}));
}

TEST(Split, StraightCornersStayVertices) {
  const Fragment straight = fragment_of(
      {{0, 0, 5}, {2, 0, 5}, {4, 0, 5}, {4, 4, 5}, {2, 4, 5}, {0, 4, 5}});
  // Through both straight corners: 6 + 4 - 2 edges.
  const auto [positive, negative] =
      split(straight, plane(1, 0, 0, -2), kSplitterId);
  EXPECT_EQ(positive.vertices, points({{2, 0}, {4, 0}, {4, 4}, {2, 4}}));
  EXPECT_EQ(negative.vertices, points({{0, 0}, {2, 0}, {2, 4}, {0, 4}}));
}

TEST(Split, NamesDoNotDependOnTheFirstVertex) {
  Fragment fragment = square();
  const FragmentName name = name_of(fragment);
  std::rotate(fragment.edges.begin(), fragment.edges.begin() + 2,
              fragment.edges.end());
  EXPECT_EQ(name_of(fragment), name);
  EXPECT_EQ(name.edges.front(), (EdgeName{kSource, 0}));
}

TEST(Split, APolygonOnOneSideIsABrokenPrecondition) {
  EXPECT_DEATH(split(square(), plane(1, 0, 0, 0), kSplitterId), "precondition");
}

}  // namespace
}  // namespace halfspace::ref
