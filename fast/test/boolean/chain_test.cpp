#include "halfspace/fast/chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "lattice.hpp"

namespace halfspace::fast {
namespace {

using lattice::Cubes;

Cubes cube_at(int i, int j, int k) {
  Cubes cubes;
  cubes.full[static_cast<std::size_t>(
      (i * lattice::kSize + j) * lattice::kSize + k)] = true;
  return cubes;
}

void expect_outline(const Solid& solid, const Cubes& cubes) {
  ASSERT_TRUE(bad_edges(solid).empty());
  bool whole = false;
  ASSERT_TRUE(lattice::outline(solid, whole) == lattice::outline(cubes));
  ASSERT_TRUE(whole);
}

bool same_bytes(const ExportedMesh& a, const ExportedMesh& b) {
  return a.vertices == b.vertices && a.first_corner == b.first_corner &&
         a.corners == b.corners && a.colors == b.colors;
}

TEST(FastChain, EveryStepIsRight) {
  std::uint64_t state = 23;
  for (int row = 0; row < 6; ++row) {
    Cubes cubes = lattice::random_cubes(1 + row % 4, state);
    Chain chain(to_solid(lattice::surface(cubes)));
    for (int step = 0; step < 8; ++step) {
      SCOPED_TRACE("row " + std::to_string(row) + ", step " +
                   std::to_string(step));
      // Now and then a solid of a table of its own.
      const Cubes other =
          step % 4 == 3 ? lattice::random_cubes(2, state)
                        : cube_at((row + 3 * step) % 8, step, (5 * step) % 8);
      const auto surface = lattice::surface(other);
      const Solid tool =
          step % 3 == 0 ? to_solid(surface) : to_solid(surface, chain.solid());
      const BooleanOp operation = step % 7 == 6   ? BooleanOp::kIntersection
                                  : step % 2 == 0 ? BooleanOp::kUnion
                                                  : BooleanOp::kDifference;
      const bool is_union = operation == BooleanOp::kUnion;
      const bool is_difference = operation == BooleanOp::kDifference;
      for (std::size_t i = 0; i < cubes.full.size(); ++i) {
        const bool a = cubes.full[i], b = other.full[i];
        cubes.full[i] = is_union ? a || b : a && (is_difference ? !b : b);
      }
      chain.apply(operation, tool);
      ASSERT_NO_FATAL_FAILURE(expect_outline(chain.solid(), cubes));
      // What is outside the one and inside the complement of the other.
      if (!is_difference) continue;
      chain.apply(BooleanOp::kIntersection, complement(tool));
      ASSERT_NO_FATAL_FAILURE(expect_outline(chain.solid(), cubes));
    }
  }
}

TEST(FastChain, UnionsAreTheSameInAnyOrderAndLeast) {
  std::vector<Cubes> all;
  for (int i = 0; i < 64; ++i) all.push_back(cube_at(i / 16, i / 4 % 4, i % 4));
  std::vector<Solid> solids;
  for (const Cubes& cubes : all) {
    const auto part = static_cast<std::int32_t>(solids.size());
    solids.push_back(solids.empty()
                         ? to_solid(lattice::surface(cubes))
                         : to_solid(lattice::surface(cubes), solids[0], part));
  }
  const auto least = [](const Solid& solid) {
    return to_mesh(merge_faces(solid, Merge::kPlane), {.triangles = true});
  };
  const ExportedMesh block = least(boolean_all(BooleanOp::kUnion, solids));
  EXPECT_EQ(block.faces.size(), 12u);
  EXPECT_EQ(block.vertices.size(), 8u);
  // Every other cube, in three orders, and one after the other.
  std::vector<Solid> some;
  for (std::size_t i = 0; i < solids.size(); i += 2 + i % 3)
    some.push_back(solids[i]);
  const ExportedMesh expected = least(boolean_all(BooleanOp::kUnion, some));
  EXPECT_GT(expected.faces.size(), 12u);
  for (int turn = 0; turn < 3; ++turn) {
    std::rotate(some.begin(), some.begin() + 7, some.end());
    if (turn == 1) std::reverse(some.begin(), some.end());
    EXPECT_TRUE(
        same_bytes(least(boolean_all(BooleanOp::kUnion, some)), expected));
    Chain chain(some[0]);
    for (std::size_t i = 1; i < some.size(); ++i)
      chain.apply(BooleanOp::kUnion, some[i]);
    EXPECT_TRUE(same_bytes(least(chain.solid()), expected));
  }
  // The block without some of its cubes, one after the other and at once.
  Chain rest(boolean_all(BooleanOp::kUnion, solids));
  for (const Solid& cube : some) rest.apply(BooleanOp::kDifference, cube);
  some.insert(some.begin(), boolean_all(BooleanOp::kUnion, solids));
  EXPECT_TRUE(same_bytes(least(rest.solid()),
                         least(boolean_all(BooleanOp::kDifference, some))));
}

/// Cubes under a linear map: of two such maps, no two solids have a plane in
/// common but by chance, and corners of what is cut are fractions. Coordinates
/// and slopes have either sign.
GridSolid skewed(int which, const Cubes& cubes, const GridPoint& by = {}) {
  SceneData data = lattice::surface(cubes).scene().data();
  for (GridPoint& p : data.vertices) {
    p = {5 * p.x + (which % 4 == 2 ? -2 : which % 4) * p.y + by.x - 60,
         4 * p.y + which % 3 * p.z + which + by.y - 50,
         6 * p.z - which % 2 * p.x + by.z - 20};
  }
  return *make_solid(*make_scene(std::move(data)));
}

GridSolid skewed(int which, std::uint64_t& state) {
  return skewed(which, lattice::random_cubes(4, state));
}

TEST(FastChain, UnionsOfAnySolidsAreTheSameInAnyOrder) {
  std::uint64_t state = 37;
  std::vector<GridSolid> all;
  for (int i = 0; i < 7; ++i) all.push_back(skewed(i, state));
  const auto least = [](const Solid& solid) {
    return to_mesh(merge_faces(solid, Merge::kPlane), {.triangles = true});
  };
  std::optional<ExportedMesh> expected;
  for (std::size_t step = 1; step < 7; ++step) {
    // The table of planes and points, too, begins with another one.
    std::vector<Solid> solids;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const GridSolid& solid = all[(step + i * step) % 7];
      solids.push_back(i == 0 ? to_solid(solid) : to_solid(solid, solids[0]));
    }
    const ExportedMesh at_once = least(boolean_all(BooleanOp::kUnion, solids));
    if (!expected) expected = at_once;
    EXPECT_GT(at_once.moved, 20u);
    EXPECT_TRUE(same_bytes(at_once, *expected));
    Chain chain(solids[0]);
    for (std::size_t i = 1; i < solids.size(); ++i)
      chain.apply(BooleanOp::kUnion, solids[i]);
    EXPECT_TRUE(same_bytes(least(chain.solid()), *expected));
  }
}

/// Plates with holes, three by three beside each other.
Solid plates(std::uint64_t& state, const Solid* with) {
  Solid first;
  std::vector<Solid> parts;
  for (std::int64_t part = 0; part < 9; ++part) {
    Cubes cubes;
    for (std::size_t i = 0; i < cubes.full.size(); ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const bool odd = i / 64 % 2 == 1 && i / 8 % 2 == 1;
      cubes.full[i] = i % 8 % 4 == 1 && (!odd || (state >> 33) % 8 == 0);
    }
    const auto solid = skewed(0, cubes, {part / 3 * 40, part % 3 * 32, 0});
    if (with == nullptr) {
      first = to_solid(solid);
      with = &first;
    }
    parts.push_back(to_solid(solid, *with));
  }
  return boolean_all(BooleanOp::kUnion, parts);
}

TEST(FastChain, FacesWithManyEdgesAreCutAsTheirPartsAre) {
  // The same plates as squares, which have few edges, and as whole faces.
  std::uint64_t state = 53;
  std::size_t most = 0;
  const auto least = [](const Solid& solid) {
    return to_mesh(merge_faces(solid, Merge::kPlane), {.triangles = true});
  };
  for (int row = 0; row < 3; ++row) {
    SCOPED_TRACE("row " + std::to_string(row));
    const Solid squares = plates(state, nullptr);
    const Solid whole = merge_faces(squares, Merge::kPlane);
    for (const Face& face : whole.faces)
      most = std::max(most, std::size_t{face.edge_count});
    // Another one under the same map has planes in common with it.
    const Solid other =
        row == 0 ? plates(state, &squares)
                 : to_solid(skewed(row, lattice::random_cubes(4, state),
                                   {50, 40, 1 - row}),
                            squares);
    const Solid other_whole = merge_faces(other, Merge::kPlane);
    for (const BooleanOp operation :
         {BooleanOp::kUnion, BooleanOp::kIntersection,
          BooleanOp::kDifference}) {
      for (const bool swapped : {false, true}) {
        const auto result = [&](const Solid& a, const Solid& b) {
          return boolean(operation, swapped ? b : a, swapped ? a : b);
        };
        const Solid of_whole = result(whole, other_whole);
        ASSERT_TRUE(bad_edges(of_whole).empty());
        ASSERT_TRUE(same_bytes(least(of_whole), least(result(squares, other))));
      }
    }
    // One small tool after another, here and there.
    Chain few(squares), chain(whole);
    for (int step = 0; step < 24; ++step) {
      const Cubes cube = cube_at((5 * step + row) % 8, (3 * step) % 8,
                                 step % 5 == 4 ? 6 : 4 * (step % 2) + 1);
      const GridPoint by{step % 3 * 40, step / 3 % 3 * 32, 0};
      const Solid tool = to_solid(skewed(step % 4, cube, by), squares);
      const BooleanOp operation =
          step % 5 == 4 ? BooleanOp::kUnion : BooleanOp::kDifference;
      few.apply(operation, tool);
      chain.apply(operation, tool);
      ASSERT_TRUE(bad_edges(chain.solid()).empty());
      if (step % 8 != 7) continue;
      ASSERT_TRUE(same_bytes(least(chain.solid()), least(few.solid())));
    }
  }
  // So that there are groups of blocks of edges.
  EXPECT_GT(most, 512u);
}

}  // namespace
}  // namespace halfspace::fast
