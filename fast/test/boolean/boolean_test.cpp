#include "halfspace/fast/boolean.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <string>
#include <utility>

#include "cases.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "intersect/candidates.hpp"
#include "intersect/point_location.hpp"
#include "lattice.hpp"

namespace halfspace::fast {
namespace {

using lattice::Cubes;

Cubes combined(BooleanOp operation, const Cubes& a, const Cubes& b) {
  Cubes result;
  for (std::size_t i = 0; i < result.full.size(); ++i)
    result.full[i] = is_member(operation, a.full[i], b.full[i]);
  return result;
}

/// How many triangles the mesh has, and that it is closed.
std::size_t triangles_of(const Solid& solid) {
  const ExportedMesh mesh = to_mesh(solid, {.triangles = true});
  EXPECT_TRUE(mesh.flipped.empty());
  std::map<std::pair<VertexId, VertexId>, int> uses;
  for (std::size_t p = 0; p < mesh.faces.size(); ++p) {
    EXPECT_EQ(mesh.first_corner[p + 1], 3 * p + 3);
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId from = mesh.corners[3 * p + i];
      const VertexId to = mesh.corners[3 * p + (i + 1) % 3];
      uses[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (const auto& [edge, excess] : uses) EXPECT_EQ(excess, 0);
  return mesh.faces.size();
}

/// Six times the volume, which is exact for small whole coordinates.
double volume6(const ExportedMesh& mesh) {
  double sum = 0;
  for (std::size_t p = 0; p < mesh.faces.size(); ++p) {
    const auto at = [&](std::size_t i) {
      return mesh.vertices[static_cast<std::size_t>(
          mesh.corners[mesh.first_corner[p] + i])];
    };
    const auto a = at(0);
    for (std::uint32_t i = 2;
         i < mesh.first_corner[p + 1] - mesh.first_corner[p]; ++i) {
      const auto b = at(i - 1);
      const auto c = at(i);
      sum += a[0] * (b[1] * c[2] - b[2] * c[1]) +
             a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  }
  return sum;
}

void expect_cubes(const Solid& solid, const Cubes& cubes) {
  ASSERT_TRUE(bad_edges(solid).empty());
  bool whole = false;
  ASSERT_TRUE(lattice::outline(solid, whole) == lattice::outline(cubes));
  ASSERT_TRUE(whole);
  const Solid least = merge_faces(solid, Merge::kPlane);
  ASSERT_TRUE(bad_edges(least).empty());
  ASSERT_TRUE(lattice::outline(least, whole) == lattice::outline(cubes));
  ASSERT_TRUE(whole);
  ASSERT_TRUE(lattice::is_least(least));
  triangles_of(least);
  const auto count = std::count(cubes.full.begin(), cubes.full.end(), true);
  ASSERT_EQ(volume6(to_mesh(least)), 6.0 * static_cast<double>(count));
}

/// What is checked of a campaign's many pairs: the surface, and that merged it
/// is the least.
void expect_surface(const Solid& solid, const Cubes& cubes) {
  ASSERT_TRUE(bad_edges(solid).empty());
  bool whole = false;
  ASSERT_TRUE(lattice::outline(solid, whole) == lattice::outline(cubes));
  ASSERT_TRUE(whole);
  ASSERT_TRUE(lattice::is_least(merge_faces(solid, Merge::kPlane)));
}

TEST(FastBoolean, SolidsOfCubesAreCombinedCubeByCube) {
  std::uint64_t state = 17;
  for (std::size_t pair = 0; pair < cases(40); ++pair) {
    SCOPED_TRACE("pair " + std::to_string(pair));
    const int lump = pair % 4 == 0 ? 1 : pair % 4 == 3 ? 4 : 2;
    const Cubes a = lattice::random_cubes(lump, state);
    const Cubes b = lattice::random_cubes(pair % 5 == 0 ? 1 : 2, state);
    const Cubes c = lattice::random_cubes(4, state);
    const Solid first = to_solid(lattice::surface(a));
    const Solid second = to_solid(lattice::surface(b), first);
    const Solid third = to_solid(lattice::surface(c), first);
    for (const BooleanOp operation : kBooleanOps) {
      const Solid result = boolean(operation, first, second);
      const Cubes cubes = combined(operation, a, b);
      ASSERT_NO_FATAL_FAILURE(expect_cubes(result, cubes));
      // The result is an operand like any other, merged or not.
      const BooleanOp then = kBooleanOps[pair % kBooleanOps.size()];
      ASSERT_NO_FATAL_FAILURE(
          expect_cubes(boolean(then, result, third), combined(then, cubes, c)));
      ASSERT_NO_FATAL_FAILURE(
          expect_cubes(boolean(then, third, merge_faces(result, Merge::kPlane)),
                       combined(then, c, cubes)));
    }
  }
}

/// The number that the environment gives; else the other one.
std::uint64_t asked(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(FastBoolean, ManyPairsOfSolidsOfCubes) {
  const std::uint64_t count = asked("HALFSPACE_LATTICE_PAIRS", cases(100));
  std::uint64_t state = asked("HALFSPACE_LATTICE_SEED", 1) << 40;
  for (std::uint64_t pair = 0; pair < count; ++pair) {
    SCOPED_TRACE("pair " + std::to_string(pair));
    const auto lump_of = [](std::uint64_t k) {
      return k == 0 ? 1 : k == 1 ? 4 : 2;
    };
    const Cubes a = lattice::random_cubes(lump_of(pair % 8), state);
    const Cubes b = lattice::random_cubes(lump_of(pair % 7), state);
    Solid first = to_solid(lattice::surface(a));
    Solid second = to_solid(lattice::surface(b), first);
    // In unit squares, and in as few faces as can be.
    if (pair % 16 != 0) first = merge_faces(first, Merge::kPlane);
    if (pair % 16 > 1) second = merge_faces(second, Merge::kPlane);
    for (const BooleanOp operation : kBooleanOps) {
      ASSERT_NO_FATAL_FAILURE(expect_surface(boolean(operation, first, second),
                                             combined(operation, a, b)));
    }
  }
}

Cubes cubes_of(const std::array<int, 3>& low, const std::array<int, 3>& high) {
  Cubes cubes;
  for (int i = low[0]; i < high[0]; ++i) {
    for (int j = low[1]; j < high[1]; ++j) {
      for (int k = low[2]; k < high[2]; ++k)
        cubes.full[static_cast<std::size_t>(
            (i * lattice::kSize + j) * lattice::kSize + k)] = true;
    }
  }
  return cubes;
}

/// A block in six faces of one colour.
Solid colored_block(const std::array<int, 3>& low,
                    const std::array<int, 3>& high, Rgb color,
                    const Solid* with) {
  const auto surface = lattice::surface(cubes_of(low, high));
  Solid solid = merge_faces(
      with != nullptr ? to_solid(surface, *with) : to_solid(surface),
      Merge::kPlane);
  for (Face& face : solid.faces) face.color = color;
  return solid;
}

std::size_t count_color(const Solid& solid, Rgb color) {
  return static_cast<std::size_t>(
      std::count_if(solid.faces.begin(), solid.faces.end(),
                    [&](const Face& face) { return face.color == color; }));
}

TEST(FastBoolean, WhatIsLeftOfAFaceIsOneFaceAndTheFirstOnesWhereTheyMeet) {
  const Rgb red{255, 0, 0}, blue{0, 0, 255};
  const Solid large = colored_block({0, 0, 0}, {4, 4, 4}, red, nullptr);
  const Solid corner = colored_block({2, 2, 2}, {6, 6, 6}, blue, &large);
  const Solid across = boolean(BooleanOp::kUnion, large, corner);
  // Three squares and three L of each.
  EXPECT_EQ(across.faces.size(), 12u);
  EXPECT_EQ(across.edges.size(), 2 * (3u * 4 + 3 * 6));
  // One that stands in the other, on its floor.
  const Solid small = colored_block({1, 1, 0}, {3, 3, 2}, blue, &large);
  const Solid same = boolean(BooleanOp::kUnion, large, small);
  EXPECT_EQ(same.faces.size(), 6u);
  EXPECT_EQ(same.edges.size(), 24u);
  EXPECT_EQ(count_color(same, blue), 0u);
  const Solid floor = boolean(BooleanOp::kUnion, small, large);
  EXPECT_EQ(floor.faces.size(), 7u);
  EXPECT_EQ(floor.edges.size(), 24u + 2 * 4);
  EXPECT_EQ(count_color(floor, blue), 1u);
  EXPECT_EQ(boolean(BooleanOp::kIntersection, large, small).faces.size(), 6u);
  EXPECT_EQ(count_color(boolean(BooleanOp::kIntersection, large, small), red),
            1u);
}

TEST(FastBoolean, OfComplementsAreTheComplements) {
  std::uint64_t state = 3;
  for (std::size_t pair = 0; pair < 4; ++pair) {
    // The first pair: faces of a large one that a small one touches amid.
    const Cubes a = pair == 0 ? cubes_of({1, 1, 0}, {3, 3, 2})
                              : lattice::random_cubes(2, state);
    const Cubes b = pair == 0 ? cubes_of({0, 0, 0}, {4, 4, 4})
                              : lattice::random_cubes(4, state);
    const Solid first =
        merge_faces(to_solid(lattice::surface(a)), Merge::kPlane);
    const Solid second =
        merge_faces(to_solid(lattice::surface(b), first), Merge::kPlane);
    const auto expect = [&](BooleanOp operation, const Solid& x, const Solid& y,
                            const Cubes& cubes) {
      const Solid result = boolean(operation, x, y);
      EXPECT_TRUE(result.unbounded);
      ASSERT_NO_FATAL_FAILURE(expect_cubes(complement(result), cubes));
    };
    expect(BooleanOp::kDifference, complement(first), second,
           combined(BooleanOp::kUnion, a, b));
    expect(BooleanOp::kUnion, complement(first), complement(second),
           combined(BooleanOp::kIntersection, a, b));
    expect(BooleanOp::kUnion, complement(first), second,
           combined(BooleanOp::kDifference, a, b));
  }
}

/// The octahedron of radius 4 about a point.
GridSolid octahedron(const GridPoint& at) {
  SceneData data;
  for (const std::int64_t r : {4, -4}) {
    data.vertices.push_back({at.x + r, at.y, at.z});
    data.vertices.push_back({at.x, at.y + r, at.z});
    data.vertices.push_back({at.x, at.y, at.z + r});
  }
  data.corners = {0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2,
                  1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5};
  for (std::uint32_t i = 3; i <= 24; i += 3) data.first_corner.push_back(i);
  data.colors.resize(8);
  Result<Scene> scene = make_scene(std::move(data));
  EXPECT_TRUE(scene);
  Result<GridSolid> solid = make_solid(*std::move(scene));
  EXPECT_TRUE(solid);
  return *std::move(solid);
}

TEST(FastBoolean, PartsOfAFaceAreOnSidesOfTheirOwn) {
  // An octahedron that another one has cut has faces in several parts. A third
  // one often holds one of them whole, and touches none.
  std::uint64_t state = 5;
  const auto solid_at = [&](const Solid* with) {
    GridPoint at;
    for (std::int64_t* c : {&at.x, &at.y, &at.z}) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      *c = static_cast<std::int64_t>(state >> 33) % 9 - 4;
    }
    const GridSolid solid = octahedron(at);
    return with == nullptr ? to_solid(solid) : to_solid(solid, *with);
  };
  const auto volume = [](const Solid& solid) {
    triangles_of(solid);
    return volume6(to_mesh(solid));
  };
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE("triple " + std::to_string(i));
    const Solid first = solid_at(nullptr);
    const Solid cut = boolean(BooleanOp::kUnion, first, solid_at(&first));
    const Solid other = solid_at(&first);
    const double both = volume(boolean(BooleanOp::kIntersection, cut, other));
    EXPECT_NEAR(volume(boolean(BooleanOp::kUnion, cut, other)) + both,
                volume(cut) + volume(other), 1e-6);
    EXPECT_NEAR(volume(boolean(BooleanOp::kDifference, cut, other)) + both,
                volume(cut), 1e-6);
    EXPECT_NEAR(
        volume(boolean(BooleanOp::kSymmetricDifference, other, cut)) + 2 * both,
        volume(cut) + volume(other), 1e-6);
    // In a chain, where far parts stay as they are.
    Chain chain(cut);
    for (const std::int64_t far : {40, 60, 80})
      chain.apply(BooleanOp::kUnion, to_solid(octahedron({far, 0, 0}), first));
    chain.apply(BooleanOp::kDifference, other);
    EXPECT_NEAR(volume(chain.solid()) + both, volume(cut) + 3 * 512, 1e-6);
  }
}

TEST(FastBoolean, RowsOfEdgesInBoxesTellWhatTheirEdgesTell) {
  // Plates with holes, and points level with their corners.
  std::uint64_t state = 41;
  int many = 0, on = 0;
  for (std::size_t pair = 0; pair < 24; ++pair) {
    Cubes plates;
    for (std::size_t i = 0; i < plates.full.size(); ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      // Across one axis after the other.
      std::array<std::size_t, 3> at{i / 64, i / 8 % 8, i % 8};
      std::rotate(at.begin(), at.begin() + pair % 3, at.end());
      const bool odd = at[0] % 2 == 1 && at[1] % 2 == 1;
      plates.full[i] = at[2] % 3 == 1 && (state >> 33) % 8 >= (odd ? 6 : 1);
    }
    const Solid a =
        merge_faces(to_solid(lattice::surface(plates)), Merge::kPlane);
    const Solid b =
        to_solid(lattice::surface(lattice::random_cubes(1, state)), a);
    const EdgePackets blocks(a);
    const PointLocator rows(a, *a.table, nullptr, &blocks);
    const PointLocator edges(a, *a.table, nullptr, nullptr);
    for (std::size_t f = 0; f < a.faces.size(); ++f) {
      if (a.faces[f].edge_count < 48) continue;
      ++many;
      const auto face = static_cast<std::int32_t>(f);
      for (const SolidEdge& edge : b.edges) {
        for (const int axis : {0, 1, 2}) {
          const int ray_contribution =
              edges.ray_contribution(axis, face, edge.from, edge.to);
          ASSERT_EQ(rows.ray_contribution(axis, face, edge.from, edge.to),
                    ray_contribution);
          on += ray_contribution != 0;
        }
      }
    }
  }
  EXPECT_GT(many, 48);
  EXPECT_GT(on, 10000);
}

/// Blocks in a row, two steps long and two apart.
GridSolid teeth(int count) {
  SceneData data;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<VertexId>(data.vertices.size());
    for (const std::int64_t x : {4 * i, 4 * i + 2}) {
      for (const std::int64_t y : {0, 10}) {
        for (const std::int64_t z : {0, 10}) data.vertices.push_back({x, y, z});
      }
    }
    for (const int c : {0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1,
                        2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3})
      data.corners.push_back(first + c);
    for (int f = 0; f < 6; ++f) {
      data.first_corner.push_back(data.first_corner.back() + 4);
      data.colors.emplace_back();
    }
  }
  return *make_solid(*make_scene(std::move(data)));
}

/// How long a rod through all of them takes to unite with them, and to be cut
/// by them.
double time_of_rod(int count, const GridPoint& low, const GridPoint& high) {
  const Solid comb = to_solid(teeth(count));
  SceneData data = teeth(1).scene().data();
  for (GridPoint& p : data.vertices) {
    p = {p.x == 0 ? -1 : 4 * count, p.y == 0 ? low.y : high.y,
         p.z == 0 ? low.z : high.z};
  }
  const Solid rod = to_solid(*make_solid(*make_scene(std::move(data))), comb);
  const std::clock_t start = std::clock();
  const Solid both = boolean(BooleanOp::kUnion, comb, rod);
  const Solid rest = boolean(BooleanOp::kDifference, rod, comb);
  const double time = static_cast<double>(std::clock() - start);
  const double area = static_cast<double>((high.y - low.y) * (high.z - low.z));
  const double rest6 = 6 * area * (2 * count + 1);
  EXPECT_EQ(volume6(to_mesh(rest)), rest6);
  EXPECT_EQ(volume6(to_mesh(both)), 6.0 * 200 * count + rest6);
  EXPECT_TRUE(bad_edges(both).empty());
  return time;
}

TEST(FastBoolean, AnEdgeThatManyFacesCutTakesNoLongerForEach) {
  // Within the teeth, and flush with two of their sides.
  for (const auto& [low, high] :
       {std::pair(GridPoint{0, 3, 3}, GridPoint{0, 5, 5}),
        std::pair(GridPoint{0, 0, 8}, GridPoint{0, 5, 10})}) {
    const double few = time_of_rod(250, low, high);
    EXPECT_LT(time_of_rod(2000, low, high), 32 * few);
  }
}

}  // namespace
}  // namespace halfspace::fast
