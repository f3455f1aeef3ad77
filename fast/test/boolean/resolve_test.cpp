#include "halfspace/fast/resolve.hpp"

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/bsp_tree.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "lattice.hpp"

namespace halfspace::fast {
namespace {

using lattice::Cubes;

/// The surfaces of two heaps of cubes, each in as few faces as possible, as if
/// they were one solid's.
Solid both_surfaces(const Cubes& a, const Cubes& b) {
  Solid both = merge_faces(to_solid(lattice::surface(a)), Merge::kPlane);
  const Solid more =
      merge_faces(to_solid(lattice::surface(b), both), Merge::kPlane);
  const auto edges = static_cast<std::uint32_t>(both.edges.size());
  both.edges.insert(both.edges.end(), more.edges.begin(), more.edges.end());
  for (Face face : more.faces) {
    face.first_edge += edges;
    both.faces.push_back(face);
  }
  return both;
}

Cubes block(int first, int last, int up_to) {
  Cubes cubes;
  for (int i = first; i < last; ++i) {
    for (int j = first; j < last; ++j) {
      for (int k = first; k < up_to; ++k)
        cubes.full[static_cast<std::size_t>(
            (i * lattice::kSize + j) * lattice::kSize + k)] = true;
    }
  }
  return cubes;
}

TEST(FastResolve, SurfacesThatCrossThemselvesAreFound) {
  std::uint64_t state = 5;
  for (int i = 0; i < 20; ++i) {
    const Cubes cubes = lattice::random_cubes(1 + i % 3, state);
    const Solid solid = to_solid(lattice::surface(cubes));
    EXPECT_TRUE(self_intersections(solid).empty());
    EXPECT_TRUE(self_intersections(merge_faces(solid, Merge::kPlane)).empty());
  }
  // One block within another, beside it, through it, and flush with it.
  const auto found = [](const Cubes& a, const Cubes& b) {
    return self_intersections(both_surfaces(a, b));
  };
  EXPECT_TRUE(found(block(0, 6, 6), block(1, 4, 4)).empty());
  EXPECT_TRUE(found(block(0, 2, 2), block(4, 6, 6)).empty());
  const auto through = found(block(0, 4, 4), block(1, 3, 7));
  ASSERT_EQ(through.size(), 4u);
  for (const SelfIntersection& crossing : through)
    EXPECT_FALSE(crossing.in_plane);
  const auto flush = found(block(0, 4, 4), block(1, 3, 4));
  // The sides of the small one leave the common plane between the two.
  ASSERT_EQ(flush.size(), 5u);
  EXPECT_EQ(std::count_if(flush.begin(), flush.end(),
                          [](const SelfIntersection& c) { return c.in_plane; }),
            1);
  EXPECT_EQ(found(block(0, 4, 4), block(0, 4, 4)).size(), 6u);
}

/// Adds the surface of some cubes to a solid's, turned inside out if asked for.
void add_surface(const Cubes& cubes, bool turned, bool in_least_faces,
                 Solid& solid) {
  Solid more = to_solid(lattice::surface(cubes), solid);
  if (in_least_faces) more = merge_faces(more, Merge::kPlane);
  if (turned) more = complement(std::move(more));
  const auto edges = static_cast<std::uint32_t>(solid.edges.size());
  solid.edges.insert(solid.edges.end(), more.edges.begin(), more.edges.end());
  for (Face face : more.faces) {
    face.first_edge += edges;
    solid.faces.push_back(face);
  }
}

/// What check_operand() says, or that nothing is wrong.
std::string said_of(const Solid& solid) {
  const Result<Done> fine = check_operand(solid);
  return fine ? "fine" : fine.error().message;
}

TEST(FastOperand, IsRefusedWithThePlace) {
  Solid solid =
      merge_faces(to_solid(lattice::surface(block(0, 4, 4))), Merge::kPlane);
  EXPECT_EQ(said_of(solid), "fine");
  EXPECT_TRUE(open_faces(solid).empty());
  // The edges of two faces change places: all edges together are as before.
  Solid torn = solid;
  std::swap(torn.edges[torn.faces[1].first_edge],
            torn.edges[torn.faces[4].first_edge]);
  EXPECT_TRUE(bad_edges(torn).empty());
  EXPECT_EQ(open_faces(torn), (std::vector<std::int32_t>{1, 4}));
  EXPECT_NE(said_of(torn).find("make no loops"), std::string::npos);
  EXPECT_EQ(check_operand(torn).error().index, 1);
  // A face is missing.
  Solid open = solid;
  open.faces.pop_back();
  open.edges.resize(open.edges.size() - 4);
  EXPECT_NE(said_of(open).find("4 bad edges"), std::string::npos);
  // Blocks through each other, and a wall of no thickness.
  const Solid crossed = both_surfaces(block(0, 4, 4), block(2, 6, 6));
  EXPECT_NE(said_of(crossed).find(" cross near "), std::string::npos);
  Solid wall = solid;
  Solid back = complement(solid);
  wall.faces.resize(1);
  wall.faces.push_back(back.faces[0]);
  wall.faces[1].first_edge += static_cast<std::uint32_t>(wall.edges.size());
  wall.edges.insert(wall.edges.end(), back.edges.begin(), back.edges.end());
  wall.edges.resize(wall.faces[1].first_edge + 4u);
  wall.edges.erase(wall.edges.begin() + 4,
                   wall.edges.begin() + wall.faces[1].first_edge);
  wall.faces[1].first_edge = 4;
  EXPECT_TRUE(bad_edges(wall).empty());
  EXPECT_NE(said_of(wall), "fine");
}

TEST(FastOperand, WindsRoundPlacesOnceOrNotAtAll) {
  const auto said = [](std::initializer_list<std::pair<Cubes, bool>> shells,
                       bool in_least_faces) {
    Solid solid = to_solid(lattice::surface(Cubes{}));
    for (const auto& [cubes, turned] : shells)
      add_surface(cubes, turned, in_least_faces, solid);
    solid.unbounded = false;
    return said_of(solid);
  };
  const Cubes large = block(0, 6, 6), small = block(1, 4, 4);
  const Cubes tiny = block(2, 3, 3), corner = block(4, 8, 8);
  for (const bool least : {true, false}) {
    // A cavity, and a solid in it; solids side by side.
    EXPECT_EQ(said({{large, false}, {small, true}, {tiny, false}}, least),
              "fine");
    EXPECT_EQ(said({{small, false}, {block(4, 6, 6), false}}, least), "fine");
    EXPECT_EQ(said({{large, true}}, least).find("the surface is inside out"),
              0u);
    const std::string twice =
        said({{large, false}, {small, false}, {tiny, false}}, least);
    EXPECT_EQ(twice.find("the surface winds round a place twice"), 0u);
    EXPECT_NE(twice.find("1 other part "), std::string::npos);
    // A solid less what it does not have.
    EXPECT_NE(said({{small, false}, {block(6, 8, 8), true}}, least)
                  .find("inside out"),
              std::string::npos);
    // Of unit squares these have only edges in common.
    EXPECT_NE(said({{large, false}, {corner, false}}, least).find("crosses"),
              std::string::npos);
  }
}

TEST(FastResolve, WhatIsWoundRoundIsKept) {
  std::uint64_t state = 3;
  std::size_t crossed = 0;
  for (int row = 0; row < 24; ++row) {
    SCOPED_TRACE("row " + std::to_string(row));
    Solid solid = to_solid(lattice::surface(Cubes{}));
    std::array<int, lattice::kSize * lattice::kSize * lattice::kSize> winding{};
    for (int shell = 0; shell < 2 + row % 3; ++shell) {
      const Cubes cubes = lattice::random_cubes(row % 2 == 0 ? 4 : 2, state);
      const bool turned = (row + shell) % 4 == 3;
      add_surface(cubes, turned, (row + shell) % 3 != 0, solid);
      for (std::size_t i = 0; i < winding.size(); ++i)
        winding[i] += cubes.full[i] ? (turned ? -1 : 1) : 0;
    }
    Cubes expected;
    for (std::size_t i = 0; i < winding.size(); ++i)
      expected.full[i] = winding[i] > 0;
    ASSERT_TRUE(bad_edges(solid).empty());
    const Resolved resolved = resolve(solid);
    crossed += resolved.self_intersections.size();
    ASSERT_TRUE(bad_edges(resolved.solid).empty());
    bool whole = false;
    ASSERT_TRUE(lattice::outline(resolved.solid, whole) ==
                lattice::outline(expected));
    ASSERT_TRUE(whole);
    EXPECT_TRUE(self_intersections(resolved.solid).empty());
    // Nothing is left to do.
    const Resolved again = resolve(resolved.solid);
    EXPECT_TRUE(again.self_intersections.empty());
    EXPECT_EQ(again.faces_cut + again.faces_dropped, 0u);
    EXPECT_EQ(again.solid.edges, resolved.solid.edges);
  }
  EXPECT_GT(crossed, 100u);
}

/// A tetrahedron whose corners are anywhere, as long as it has a volume.
GridSolid tetrahedron(std::uint64_t& state) {
  SceneData data;
  while (true) {
    data.vertices.clear();
    std::array<std::array<std::int64_t, 3>, 4> p;
    for (auto& corner : p) {
      for (std::int64_t& c : corner) {
        c = static_cast<std::int64_t>(mix(++state) % 41);
      }
      data.vertices.push_back({corner[0], corner[1], corner[2]});
    }
    const auto d = [&](std::size_t i, std::size_t k) {
      return p[i][k] - p[0][k];
    };
    const std::int64_t volume6 =
        d(1, 0) * (d(2, 1) * d(3, 2) - d(2, 2) * d(3, 1)) +
        d(1, 1) * (d(2, 2) * d(3, 0) - d(2, 0) * d(3, 2)) +
        d(1, 2) * (d(2, 0) * d(3, 1) - d(2, 1) * d(3, 0));
    if (volume6 > 0) break;
  }
  data.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  data.first_corner = {0, 3, 6, 9, 12};
  data.colors.resize(4);
  auto scene = make_scene(std::move(data));
  EXPECT_TRUE(scene.has_value());
  auto solid = make_solid(*std::move(scene));
  EXPECT_TRUE(solid.has_value());
  return *std::move(solid);
}

TEST(FastResolve, SolidsThroughEachOtherBecomeTheirUnion) {
  std::uint64_t state = 8;
  const auto least = [](const Solid& solid) {
    return to_mesh(merge_faces(solid, Merge::kPlane), {.triangles = true});
  };
  std::size_t crossed = 0;
  for (int row = 0; row < 30; ++row) {
    SCOPED_TRACE("row " + std::to_string(row));
    std::vector<Solid> solids{to_solid(tetrahedron(state))};
    Solid all = solids[0];
    for (int i = 0; i < 2 + row % 3; ++i) {
      solids.push_back(to_solid(tetrahedron(state), all));
      const auto edges = static_cast<std::uint32_t>(all.edges.size());
      for (Face face : solids.back().faces) {
        face.first_edge += edges;
        all.faces.push_back(face);
      }
      all.edges.insert(all.edges.end(), solids.back().edges.begin(),
                       solids.back().edges.end());
    }
    const Resolved resolved = resolve(all);
    crossed += resolved.self_intersections.size();
    ASSERT_TRUE(bad_edges(resolved.solid).empty());
    const ExportedMesh mesh = least(resolved.solid);
    const ExportedMesh expected = least(boolean_all(BooleanOp::kUnion, solids));
    ASSERT_TRUE(mesh.vertices == expected.vertices &&
                mesh.corners == expected.corners);
    EXPECT_TRUE(resolve(resolved.solid).self_intersections.empty());
  }
  EXPECT_GT(crossed, 100u);
}

}  // namespace
}  // namespace halfspace::fast
