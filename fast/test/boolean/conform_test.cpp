#include "boolean/conform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "boolean/arrangement.hpp"
#include "boolean/conform.hpp"
#include "cases.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "lattice.hpp"
#include "scenes.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

using Block = std::pair<GridPoint, GridPoint>;

/// Blocks between two corners each, as one surface.
Solid blocks(std::initializer_list<Block> list) {
  std::vector<GridPoint> vertices;
  std::vector<std::vector<VertexId>> polygons;
  for (const auto& [p, q] : list) {
    const auto first = static_cast<VertexId>(vertices.size());
    for (int i = 0; i < 8; ++i) {
      vertices.push_back(
          {i & 1 ? q.x : p.x, i & 2 ? q.y : p.y, i & 4 ? q.z : p.z});
    }
    for (const std::vector<VertexId>& face : {std::vector<VertexId>{0, 2, 3, 1},
                                              {4, 5, 7, 6},
                                              {0, 1, 5, 4},
                                              {2, 6, 7, 3},
                                              {0, 4, 6, 2},
                                              {1, 3, 7, 5}}) {
      std::vector<VertexId>& corners = polygons.emplace_back();
      for (const VertexId v : face) corners.push_back(first + v);
    }
  }
  return solid_of(vertices, polygons);
}

/// Two blocks of which an edge of either lies in part in one of the other's.
Solid two_that_touch() {
  return blocks({{{0, 2, 0}, {2, 4, 1}}, {{2, 0, 0}, {4, 2, 3}}});
}

/// A block, and a prism with one edge on the middle of it.
Solid prism_on_block() {
  return solid_of({{0, 0, 0},
                   {4, 0, 0},
                   {4, 4, 0},
                   {0, 4, 0},
                   {0, 0, 2},
                   {4, 0, 2},
                   {4, 4, 2},
                   {0, 4, 2},
                   {1, 2, 2},
                   {3, 2, 2},
                   {1, 1, 4},
                   {3, 1, 4},
                   {1, 3, 4},
                   {3, 3, 4}},
                  {{0, 3, 2, 1},
                   {4, 5, 6, 7},
                   {0, 1, 5, 4},
                   {1, 2, 6, 5},
                   {2, 3, 7, 6},
                   {3, 0, 4, 7},
                   {8, 9, 11, 10},
                   {9, 8, 12, 13},
                   {10, 11, 13, 12},
                   {8, 10, 12},
                   {9, 13, 11}});
}

/// A solid and tetrahedra.
Solid with_tetrahedra(Solid solid,
                      const std::vector<std::array<GridPoint, 4>>& list) {
  for (const auto& corners : list) {
    SceneData data;
    data.unit = {10, -3};
    data.vertices.assign(corners.begin(), corners.end());
    data.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    data.first_corner = {0, 3, 6, 9, 12};
    data.colors.resize(4);
    const Solid more = to_solid(*make_solid(made(std::move(data))), solid);
    const auto edges = static_cast<std::uint32_t>(solid.edges.size());
    for (Face face : more.faces) {
      face.first_edge += edges;
      solid.faces.push_back(face);
    }
    solid.edges.insert(solid.edges.end(), more.edges.begin(), more.edges.end());
  }
  return solid;
}

double volume(const Solid& solid) {
  const ExportedMesh mesh = to_mesh(solid, {.triangles = true});
  double sum = 0;
  for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return mesh.vertices[static_cast<std::size_t>(mesh.corners[i + k])];
    };
    const auto p = at(0), q = at(1), r = at(2);
    sum += p[0] * (q[1] * r[2] - q[2] * r[1]) +
           p[1] * (q[2] * r[0] - q[0] * r[2]) +
           p[2] * (q[0] * r[1] - q[1] * r[0]);
  }
  // In thousandths.
  return sum * 1e9 / 6;
}

/// Whether every face lies in the plane of the face that it comes from, which
/// is the operand's.
bool has_right_sources(const Solid& result, const Solid& a, const Solid& b) {
  for (const Face& face : result.faces) {
    const auto& faces = (face.from_first ? a : b).faces;
    const auto source = static_cast<std::size_t>(face.source);
    if (source >= faces.size() || faces[source].polygon != face.polygon)
      return false;
  }
  return true;
}

/// The booleans of a solid that touches itself, and their volumes: what both
/// have in common is `common`.
void expect_right(const Solid& a, const Solid& b, double common) {
  const double of_a = volume(a), of_b = volume(b);
  const std::pair<BooleanOp, double> expected[] = {
      {BooleanOp::kUnion, of_a + of_b - common},
      {BooleanOp::kIntersection, common},
      {BooleanOp::kDifference, of_a - common}};
  for (const auto& [operation, size] : expected) {
    SCOPED_TRACE("operation " + std::to_string(static_cast<int>(operation)));
    const Solid result = boolean(operation, a, b);
    const Result<Done> fine = check_operand(result);
    ASSERT_TRUE(fine) << fine.error().message;
    EXPECT_NEAR(volume(result), size, 1e-6);
    EXPECT_TRUE(has_right_sources(result, a, b));
    Chain chain(a);
    chain.apply(operation, b);
    EXPECT_NEAR(volume(chain.solid()), size, 1e-6);
    EXPECT_TRUE(check_operand(chain.solid()));
  }
  const Solid turned = boolean(BooleanOp::kDifference, b, a);
  EXPECT_TRUE(check_operand(turned));
  EXPECT_NEAR(volume(turned), of_b - common, 1e-6);
  EXPECT_TRUE(has_right_sources(turned, b, a));
  Chain chain(b);
  chain.apply(BooleanOp::kDifference, a);
  EXPECT_NEAR(volume(chain.solid()), of_b - common, 1e-6);
  const Solid outside = boolean(BooleanOp::kIntersection, complement(a), b);
  EXPECT_TRUE(check_operand(outside));
  EXPECT_NEAR(volume(outside), of_b - common, 1e-6);
}

TEST(FastConform, IsKnownOfWhatIsConvexAndSmall) {
  EXPECT_TRUE(is_known_conforming(blocks({})));
  EXPECT_TRUE(is_known_conforming(blocks({{{0, 0, 0}, {1, 2, 3}}})));
  EXPECT_FALSE(is_known_conforming(two_that_touch()));
  EXPECT_FALSE(is_known_conforming(prism_on_block()));
  EXPECT_FALSE(
      is_known_conforming(complement(blocks({{{0, 0, 0}, {1, 2, 3}}}))));
  // Only faces that look up are not convex, or only such as look down.
  constexpr std::size_t kRow = lattice::kSize;
  constexpr std::size_t kFour[] = {0, kRow, kRow * kRow, kRow * (kRow + 1)};
  for (const std::size_t left_out : {kFour[0], kFour[3]}) {
    lattice::Cubes cubes;
    for (const std::size_t at : kFour) cubes.full[at] = at != left_out;
    EXPECT_FALSE(is_known_conforming(
        merge_faces(to_solid(lattice::surface(cubes)), Merge::kPlane)));
  }
}

TEST(FastConform, IsPassedOnFromOperandsToResults) {
  const Solid a = blocks({{{0, 0, 0}, {2, 2, 2}}});
  const Solid b = blocks({{{1, 1, 1}, {3, 3, 3}}});
  const Solid both = boolean(BooleanOp::kUnion, a, b);
  EXPECT_TRUE(both.is_conforming);
  EXPECT_TRUE(merge_faces(complement(both), Merge::kPlane).is_conforming);
  EXPECT_TRUE(boolean(BooleanOp::kDifference, both, b).is_conforming);
  // Nothing has to be known of what nothing is near.
  const Solid far = blocks({{{9, 9, 9}, {10, 10, 10}}});
  const Solid some = boolean(BooleanOp::kUnion, two_that_touch(), far);
  EXPECT_FALSE(some.is_conforming);
  Chain chain(far);
  chain.apply(BooleanOp::kUnion, blocks({{{8, 8, 8}, {9, 9, 9}}}));
  EXPECT_TRUE(chain.solid().is_conforming);
  chain.apply(BooleanOp::kUnion, some);
  EXPECT_FALSE(chain.solid().is_conforming);
}

TEST(FastConform, PartsFacesWhereTheSurfaceTouchesItself) {
  for (const Solid& solid : {two_that_touch(), prism_on_block()}) {
    const Solid parted = with_lease(solid, conforming);
    EXPECT_TRUE(parted.is_conforming);
    EXPECT_TRUE(check_operand(parted));
    EXPECT_GT(parted.edges.size(), solid.edges.size());
    EXPECT_NEAR(volume(parted), volume(solid), 1e-6);
    const Solid again = with_lease(parted, conforming);
    EXPECT_EQ(again.edges, parted.edges);
    EXPECT_EQ(with_lease(complement(solid), conforming).edges,
              complement(parted).edges);
  }
  Solid open = two_that_touch();
  open.edges.resize(open.edges.size() - open.faces.back().edge_count);
  open.faces.pop_back();
  EXPECT_EQ(with_lease(open, conforming).edges, open.edges);
  EXPECT_TRUE(with_lease(open, conforming).is_conforming);
}

/// Whether either operand has nodes where the other one meets it.
std::array<bool, 2> have_nodes(const Solid& a, const Solid& b) {
  TableLease lease = *TableLease::of(a.table);
  const Solid tool = moved_to(b, lease);
  Arrangement found(BooleanOp::kUnion, a, tool, lease);
  found.find_contacts();
  return {found.conforms(0), found.conforms(1)};
}

constexpr std::array<bool, 2> kBoth{true, true};

TEST(FastConform, IsAskedForOnlyWhereAFaceHasAnEdgeThatIsNotItsOwn) {
  const std::array<bool, 2> not_first{false, true}, not_second{true, false};
  const Solid a = two_that_touch();
  const Solid beside = blocks({{{1, 1, 0}, {2, 2, 1}}});
  EXPECT_EQ(have_nodes(a, beside), not_first);
  EXPECT_EQ(have_nodes(beside, a), not_second);
  EXPECT_EQ(
      have_nodes(a, blocks({{{0, 2, 0}, {2, 4, 2}}, {{2, 0, 0}, {4, 2, 3}}})),
      (std::array{false, false}));
  // What both have needs no look.
  EXPECT_EQ(have_nodes(a, a), kBoth);
  // Beyond the part that both have: near it, and where nothing is near it.
  EXPECT_EQ(have_nodes(a, blocks({{{1, 1, 1}, {2, 2, 3}}})), not_first);
  EXPECT_EQ(have_nodes(a, blocks({{{1, 1, 2}, {2, 2, 3}}})), kBoth);
  // Along a side, and across.
  EXPECT_EQ(have_nodes(a, blocks({{{0, 3, 0}, {1, 4, 1}}})), kBoth);
  EXPECT_EQ(have_nodes(a, blocks({{{1, 1, -1}, {3, 3, 5}}})), kBoth);
  const Solid c = prism_on_block();
  EXPECT_EQ(have_nodes(c, blocks({{{1, 2, 2}, {3, 3, 3}}})), not_first);
  EXPECT_EQ(have_nodes(c, blocks({{{0, 0, 2}, {4, 1, 3}}})), kBoth);
  // Neither edges nor points that faces share by right.
  std::uint64_t state = 11;
  const auto count = static_cast<int>(cases(40));
  for (int i = 0; i < count; ++i) {
    const Solid x =
        to_solid(lattice::surface(lattice::random_cubes(1 + i % 3, state)));
    const Solid y =
        to_solid(lattice::surface(lattice::random_cubes(1 + i % 2, state)));
    EXPECT_EQ(have_nodes(x, x), kBoth);
    EXPECT_EQ(have_nodes(x, y), kBoth);
    EXPECT_EQ(have_nodes(merge_faces(x, Merge::kPlane), y), kBoth);
  }
}

TEST(FastConform, BooleansAreRightWhereEdgesLieInEdgesInPart) {
  const Solid a = two_that_touch();
  // Between the two, at the edges that lie in each other.
  expect_right(a, blocks({{{1, 1, 0}, {2, 2, 1}}}), 0);
  expect_right(a, blocks({{{1, 1, 0}, {2, 2, 3}}}), 0);
  // Right through, with a face through both edges.
  expect_right(a, blocks({{{1, 1, 0}, {2, 4, 1}}}), 2);
  expect_right(a, blocks({{{2, 1, 0}, {3, 3, 3}}}), 3);
  // Another that touches itself there, and itself.
  expect_right(a, blocks({{{0, 1, 0}, {2, 2, 2}}, {{2, 2, 1}, {3, 3, 3}}}), 0);
  expect_right(a, a, volume(a));
}

TEST(FastConform, BooleansAreRightWhereAnEdgeLiesInAFace) {
  const Solid a = prism_on_block();
  // Beside the edge, on the face: right at it, and beyond its ends.
  expect_right(a, blocks({{{1, 2, 2}, {3, 3, 3}}}), 0.5);
  expect_right(a, blocks({{{0, 2, 2}, {4, 3, 3}}}), 0.5);
  // Across the face, with faces in its plane and in the edge's.
  expect_right(a, blocks({{{2, 1, 1}, {4, 3, 2}}}), 4);
  expect_right(a, blocks({{{0, 2, 0}, {4, 4, 3}}}), 16.5);
  expect_right(a, blocks({{{0, 0, 2}, {4, 4, 5}}}), volume(a) - 32);
  // Through the edge.
  expect_right(a, blocks({{{2, -1, -1}, {5, 5, 5}}}), volume(a) / 2);
}

TEST(FastConform, BooleansAreRightWhereManyEdgesLieInAFace) {
  constexpr int kPrisms = 12;
  std::vector<GridPoint> vertices;
  std::vector<std::vector<VertexId>> polygons;
  const auto add = [&](const std::vector<GridPoint>& points,
                       const std::vector<std::vector<VertexId>>& faces) {
    const auto first = static_cast<VertexId>(vertices.size());
    vertices.insert(vertices.end(), points.begin(), points.end());
    for (std::vector<VertexId> face : faces) {
      for (VertexId& v : face) v += first;
      polygons.push_back(face);
    }
  };
  constexpr std::int64_t kLong = 2 * kPrisms;
  add({{0, 0, 0},
       {0, kLong, 0},
       {0, kLong, 1},
       {0, 0, 1},
       {4, 0, 0},
       {4, kLong, 0},
       {4, kLong, 1},
       {4, 0, 1}},
      {{3, 2, 1, 0},
       {4, 5, 6, 7},
       {0, 1, 5, 4},
       {1, 2, 6, 5},
       {2, 3, 7, 6},
       {3, 0, 4, 7}});
  for (std::int64_t y = 1; y < kLong; y += 2) {
    add({{1, y, 1},
         {1, y + 1, 2},
         {1, y, 2},
         {3, y, 1},
         {3, y + 1, 2},
         {3, y, 2}},
        {{2, 1, 0}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}});
  }
  const Solid a = solid_of(vertices, polygons);
  ASSERT_TRUE(check_operand(a));
  expect_right(a, blocks({{{2, -1, -1}, {5, kLong + 1, 5}}}), volume(a) / 2);
}

TEST(FastConform, BooleansAreRightWhereAnEdgeLiesInAFaceWithManyEdges) {
  lattice::Cubes board;
  for (std::size_t i = 0; i < lattice::kSize; ++i) {
    for (std::size_t j = 0; j < lattice::kSize; ++j) {
      board.full[(i * lattice::kSize + j) * lattice::kSize] =
          i % 2 == 0 || j % 2 == 0;
    }
  }
  const Solid whole =
      merge_faces(to_solid(lattice::surface(board)), Merge::kPlane);
  const Solid a =
      with_tetrahedra(whole, {{{{2, 2, 1}, {3, 3, 1}, {2, 3, 3}, {3, 2, 3}}}});
  ASSERT_TRUE(check_operand(a));
  EXPECT_TRUE(
      std::any_of(a.faces.begin(), a.faces.end(), EdgePackets::has_many));
  Solid b = blocks({{{2, 2, 1}, {3, 3, 2}}});
  b.unit = a.unit;
  EXPECT_EQ(have_nodes(a, b), (std::array{false, true}));
  const Solid any = boolean(BooleanOp::kUnion, a, b);
  const Solid common = boolean(BooleanOp::kIntersection, a, b);
  EXPECT_TRUE(check_operand(any));
  EXPECT_TRUE(check_operand(common));
  EXPECT_GT(volume(common), 0);
  EXPECT_DOUBLE_EQ(volume(any) + volume(common), volume(a) + volume(b));
}

/// Whether every vertex of the boolean that lies on an edge is a corner there,
/// whichever operand is the first.
void expect_corners(const Solid& a, const Solid& b) {
  for (const BooleanOp operation :
       {BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference}) {
    for (const bool swapped : {false, true}) {
      const Solid result =
          swapped ? boolean(operation, b, a) : boolean(operation, a, b);
      EXPECT_EQ(resolve(result).faces_cut, 0u);
    }
  }
}

/// The point with its coordinates passed on to the next axes.
GridPoint turned(const GridPoint& p, int times) {
  GridPoint q = p;
  for (; times > 0; --times) q = {q.z, q.x, q.y};
  return q;
}

TEST(FastConform, APointOnAnEdgeThatTheOtherCoversIsACorner) {
  using Tetrahedron = std::array<GridPoint, 4>;
  // With a face along the edge, with none, with an edge across it, and at
  // another edge.
  const Tetrahedron along{{{1, 1, 1}, {3, 2, 0}, {3, 3, 1}, {3, 2, 2}}};
  const Tetrahedron askew{{{1, 1, 4}, {4, 2, 3}, {5, 5, 4}, {3, 4, 6}}};
  const Tetrahedron across{{{0, 2, 7}, {2, 0, 7}, {3, 3, 6}, {3, 3, 8}}};
  const Tetrahedron beside{{{0, 1, 5}, {-4, 0, 4}, {-3, 2, 7}, {-5, 2, 5}}};
  const std::vector<GridPoint> prism{{1, 1, 0}, {0, 2, 0}, {0, 1, 0},
                                     {1, 1, 9}, {0, 2, 9}, {0, 1, 9}};
  for (int times = 0; times < 3; ++times) {
    std::vector<GridPoint> corners;
    for (const GridPoint& p : prism) corners.push_back(turned(p, times));
    const Solid b = solid_of(
        corners,
        {{2, 1, 0}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}});
    ASSERT_TRUE(check_operand(b));
    for (std::vector<Tetrahedron> list :
         {std::vector{along}, std::vector{askew}, std::vector{across},
          std::vector{beside, askew}, std::vector{along, askew, beside},
          std::vector{across, askew, along}}) {
      for (Tetrahedron& tetrahedron : list) {
        for (GridPoint& p : tetrahedron) p = turned(p, times);
      }
      const Solid a = with_tetrahedra(
          blocks({{{0, 0, 0}, turned({1, 1, 9}, times)}}), list);
      ASSERT_TRUE(check_operand(a));
      expect_corners(a, b);
    }
  }
}

TEST(FastConform, APointOnAFaceWhereTheOtherCutsItIsACorner) {
  std::vector<std::array<GridPoint, 4>> list;
  for (const std::int64_t y : {8, 2, 5}) {
    list.push_back({{{2, y, 2}, {1, y - 1, 4}, {3, y - 1, 4}, {2, y + 1, 4}}});
    const Solid a = with_tetrahedra(blocks({{{0, 0, 0}, {4, 9, 2}}}), list);
    ASSERT_TRUE(check_operand(a));
    expect_corners(a, blocks({{{2, -1, -1}, {5, 10, 5}}}));
    expect_corners(a, blocks({{{2, 3, -1}, {5, 10, 5}}}));
  }
}

}  // namespace
}  // namespace halfspace::fast
