#include "rounding/mesh_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
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

/// A closed surface of a round grid of points, each moved at random, so that
/// many of its triangles are seen from one side, and some fold over and cross.
/// `still`: of so many in eight it is not known that they moved.
GridMesh crumpled(std::mt19937& random, std::int64_t by, std::uint32_t still) {
  constexpr std::int32_t kRound = 9, kUp = 5;
  GridMesh mesh;
  const auto off = [&] {
    return static_cast<std::int64_t>(random() %
                                     static_cast<std::uint32_t>(2 * by + 1)) -
           by;
  };
  const auto add = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    mesh.points.push_back({x + off(), y + off(), z + off()});
  };
  for (std::int32_t i = 0; i < kUp; ++i) {
    for (std::int32_t k = 0; k < kRound; ++k) {
      const double up = 3.14159 * (i + 1) / (kUp + 1);
      const double round = 2 * 3.14159 * k / kRound;
      add(std::llround(100 * std::sin(up) * std::cos(round)),
          std::llround(100 * std::sin(up) * std::sin(round)),
          std::llround(100 * std::cos(up)));
    }
  }
  add(0, 0, 100);
  add(0, 0, -100);
  const auto at = [](std::int32_t i, std::int32_t k) {
    return i < 0      ? kUp * kRound
           : i >= kUp ? kUp * kRound + 1
                      : i * kRound + k % kRound;
  };
  for (std::int32_t i = -1; i < kUp; ++i) {
    for (std::int32_t k = 0; k < kRound; ++k) {
      if (i >= 0)
        mesh.triangles.push_back({{at(i, k), at(i + 1, k), at(i, k + 1)}, 0});
      if (i + 1 < kUp) {
        mesh.triangles.push_back(
            {{at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)}, 0});
      }
    }
  }
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    mesh.moved.push_back(random() % 8 < still ? 0 : 1);
  return mesh;
}

/// Two points, and a ring that goes round between them twice.
GridMesh twice_round(std::mt19937& random) {
  constexpr std::int32_t kRing = 7;
  GridMesh mesh;
  const auto off = [&] { return static_cast<std::int64_t>(random() % 5); };
  for (std::int32_t k = 0; k < kRing; ++k) {
    const double round = 4 * 3.14159 * k / kRing;
    mesh.points.push_back({std::llround(100 * std::cos(round)) + off(),
                           std::llround(100 * std::sin(round)) + off(), off()});
  }
  mesh.points.push_back({0, 0, 60 + off()});
  mesh.points.push_back({0, 0, -60 - off()});
  for (std::int32_t k = 0; k < kRing; ++k) {
    const std::int32_t next = (k + 1) % kRing;
    mesh.triangles.push_back({{k, next, kRing}, 0});
    mesh.triangles.push_back({{next, k, kRing + 1}, 0});
  }
  mesh.moved.assign(mesh.points.size(), 1);
  return mesh;
}

/// Flat stars, packets and indices leave out no pair.
TEST(FastMeshContacts, PairsAreThoseOfAllTriangles) {
  std::mt19937 random(3);
  std::size_t with = 0, without = 0;
  for (std::uint32_t round = 0; round < 200; ++round) {
    GridMesh mesh = round % 8 == 7
                        ? twice_round(random)
                        : crumpled(random, 1 + round % 40, round % 7);
    clean(mesh);
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    const auto count = static_cast<std::int32_t>(mesh.triangles.size());
    for (std::int32_t t = 0; t < count; ++t) {
      for (std::int32_t u = t + 1; u < count; ++u) {
        const GridTriangle& a = mesh.triangles[static_cast<std::size_t>(t)];
        const GridTriangle& b = mesh.triangles[static_cast<std::size_t>(u)];
        if ((mesh.is_moved(a) || mesh.is_moved(b)) &&
            triangles_meet(mesh, a, b))
          pairs.emplace_back(t, u);
      }
    }
    ASSERT_EQ(contacts_of(mesh, 1).pairs, pairs) << round;
    ASSERT_EQ(contacts_of(mesh, 2).pairs, pairs) << round;
    (pairs.empty() ? without : with) += 1;
  }
  EXPECT_GT(with, 50u);
  EXPECT_GT(without, 50u);
}

/// Their triangles may turn about a corner once in all, and overlap.
TEST(FastMeshContacts, OpenSurfacesHaveNoFlatStars) {
  GridMesh mesh;
  mesh.points = {{0, 0, 0}, {-9, -9, 0}, {9, -9, 0}, {2, -9, -2}, {9, -1, 5}};
  mesh.moved.assign(mesh.points.size(), 1);
  mesh.triangles = {{{0, 1, 2}, 0}, {{0, 3, 4}, 0}};
  EXPECT_EQ(contacts_of(mesh, 1).pairs.size(), 1u);
}

}  // namespace
}  // namespace halfspace::fast
