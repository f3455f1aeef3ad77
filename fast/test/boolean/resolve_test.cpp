#include "halfspace/fast/resolve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "boolean/nonsense.hpp"
#include "boolean/shells.hpp"
#include "cases.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "intersect/candidates.hpp"
#include "intersect/point_location.hpp"

namespace halfspace::fast {
namespace {

TEST(Resolve, WhatIsWoundRoundIsKept) {
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

TEST(Resolve, SolidsThroughEachOtherBecomeTheirUnion) {
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

TEST(Resolve, RepairKeepsWhatIsWoundRound) {
  std::size_t crossed = 0, inside = 0;
  for (std::uint64_t seed = 1; seed <= cases(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Solid solid = nonsense(seed);
    const Resolved resolved = resolve(solid);
    if (!resolved.self_intersections.empty()) ++crossed;
    const Result<Done> fine = check_operand(resolved.solid);
    ASSERT_TRUE(fine) << fine.error().message;
    TableLease lease = *TableLease::of(solid.table);
    const PointLocator before(solid, *solid.table, nullptr, nullptr);
    const PointLocator after(resolved.solid, *solid.table, nullptr, nullptr);
    Surface draws(seed + 9000);
    for (int i = 0; i < 20; ++i) {
      const auto coordinate = [&] { return draws.draw(kStep * kPoints); };
      const std::int32_t v =
          lease.table().add_point({coordinate(), coordinate(), coordinate()});
      const bool is_inside = before.winding(v, v) > 0;
      if (is_inside) ++inside;
      ASSERT_EQ(after.winding(v, v), is_inside ? 1 : 0);
    }
  }
  EXPECT_GT(crossed, cases(200));
  EXPECT_GT(inside, cases(200));
}

}  // namespace
}  // namespace halfspace::fast
