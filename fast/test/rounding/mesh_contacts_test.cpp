#include "rounding/mesh_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace halfspace::fast {
namespace {

void add_tetrahedron(GridMesh& mesh, const std::array<GridPoint, 4>& corners,
                     bool inside_out = false) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
  mesh.moved.resize(mesh.points.size(), 1);
  std::array<std::array<std::int32_t, 3>, 4> faces = {
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  for (auto& face : faces) {
    if (inside_out) std::swap(face[0], face[1]);
    mesh.triangles.push_back(
        {{first + face[0], first + face[1], first + face[2]}, 0});
  }
}

constexpr std::array<GridPoint, 4> kLarge = {
    {{0, 0, 0}, {90, 0, 0}, {0, 90, 0}, {0, 0, 90}}};
constexpr std::array<GridPoint, 4> kWithin = {
    {{10, 10, 10}, {20, 10, 10}, {10, 20, 10}, {10, 10, 20}}};
constexpr std::array<GridPoint, 4> kBeside = {
    {{60, 60, 60}, {70, 60, 60}, {60, 70, 60}, {60, 60, 70}}};
constexpr std::array<GridPoint, 4> kThrough = {
    {{10, 10, -10}, {20, 10, -10}, {10, 20, -10}, {10, 10, 20}}};

TEST(FastMeshContacts, PartsThatWindRoundPointsTwiceAreFound) {
  GridMesh mesh;
  add_tetrahedron(mesh, kLarge);
  EXPECT_TRUE(contacts_of(mesh, 1).empty());
  add_tetrahedron(mesh, kBeside);
  EXPECT_TRUE(contacts_of(mesh, 1).empty());
  EXPECT_EQ(part_count(mesh), 2u);
  GridMesh hollow = mesh;
  add_tetrahedron(hollow, kWithin, true);
  EXPECT_TRUE(contacts_of(hollow, 1).empty());
  GridMesh twice = mesh;
  add_tetrahedron(twice, kWithin);
  EXPECT_EQ(contacts_of(twice, 1).in_parts.size(), 1u);
  GridMesh crossing = mesh;
  add_tetrahedron(crossing, kThrough);
  EXPECT_FALSE(contacts_of(crossing, 1).pairs.empty());
  // What did not move is not looked at.
  std::fill(crossing.moved.begin(), crossing.moved.end(), 0);
  EXPECT_TRUE(contacts_of(crossing, 1).empty());
}

TEST(FastMeshContacts, PartsInsideOutAreFoundAmongFewAndMany) {
  for (const int count : {1, 40}) {
    GridMesh mesh;
    for (int i = 0; i < count; ++i) {
      std::array<GridPoint, 4> at = kWithin;
      for (GridPoint& p : at) p.x += 20 * i;
      add_tetrahedron(mesh, at, i == 0);
    }
    EXPECT_EQ(contacts_of(mesh, 1).in_parts.size(), 1u);
    EXPECT_EQ(contacts_of(mesh, 2).in_parts.size(), 1u);
  }
}

TEST(FastMeshContacts, RoundAnEdgeEntriesAndExitsAlternate) {
  // Two tetrahedra with an edge in common, apart, and one within the other.
  GridMesh mesh;
  add_tetrahedron(mesh, {{{0, 0, 0}, {0, 0, 9}, {5, -3, 0}, {5, 3, 0}}});
  GridMesh beside = mesh;
  add_tetrahedron(beside, {{{0, 0, 0}, {0, 0, 9}, {-5, 3, 0}, {-5, -3, 0}}});
  GridMesh within = mesh;
  add_tetrahedron(within, {{{0, 0, 0}, {0, 0, 9}, {4, -1, 1}, {4, 1, 1}}});
  ASSERT_TRUE(contacts_of(mesh, 1).empty());
  for (GridMesh* both : {&beside, &within}) {
    for (GridTriangle& t : both->triangles) {
      for (std::int32_t& c : t.corners) {
        if (c == 4 || c == 5) c -= 4;
      }
    }
  }
  EXPECT_TRUE(contacts_of(beside, 1).empty());
  EXPECT_EQ(contacts_of(within, 1).at_edges.size(), 1u);
}

TEST(FastMeshContacts, TrianglesThatFoldOverMeet) {
  GridMesh mesh;
  mesh.points = {{0, 0, 0}, {9, 0, 0},  {0, 9, 0}, {9, 9, 0},
                 {3, 3, 0}, {4, -9, 0}, {4, 9, 3}};
  const auto meet = [&](const std::array<std::int32_t, 3>& a,
                        const std::array<std::int32_t, 3>& b) {
    const bool result = triangles_meet(mesh, {a, 0}, {b, 0});
    EXPECT_EQ(triangles_meet(mesh, {b, 0}, {a, 0}), result);
    return result;
  };
  EXPECT_FALSE(meet({0, 1, 2}, {1, 3, 2}));
  EXPECT_TRUE(meet({0, 1, 2}, {1, 0, 4}));
  EXPECT_FALSE(meet({0, 1, 2}, {1, 0, 5}));
  EXPECT_FALSE(meet({0, 1, 2}, {1, 0, 6}));
  EXPECT_TRUE(meet({0, 1, 2}, {2, 1, 0}));
  // One corner in common.
  EXPECT_FALSE(meet({0, 4, 2}, {4, 1, 3}));
  EXPECT_TRUE(meet({0, 1, 2}, {0, 4, 6}));
  EXPECT_TRUE(meet({0, 1, 2}, {4, 3, 6}));
}

}  // namespace
}  // namespace halfspace::fast
