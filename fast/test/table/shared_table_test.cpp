#include "table/shared_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <vector>

#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "lattice.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

bool same_mesh(const ExportedMesh& a, const ExportedMesh& b) {
  return a.vertices == b.vertices && a.first_corner == b.first_corner &&
         a.corners == b.corners;
}

ExportedMesh least(const Solid& solid) {
  return to_mesh(merge_faces(solid, Merge::kPlane));
}

/// A tetrahedron that no plane of cubes is parallel to.
Solid oblique(std::int64_t at, const Solid& with) {
  SceneData data;
  data.vertices = {{at, 1, 1}, {at + 6, 2, 3}, {at + 1, 7, 3}, {at + 2, 2, 7}};
  data.corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  data.first_corner = {0, 3, 6, 9, 12};
  data.colors.resize(4);
  return to_solid(*make_solid(*make_scene(std::move(data))), with);
}

TEST(SharedTable, IsLeasedToOneAtATime) {
  const auto table = std::make_shared<const SharedTable>(26);
  auto first = TableLease::of(table);
  ASSERT_TRUE(first);
  EXPECT_FALSE(TableLease::of(table));
  TableLease moved = std::move(*first);
  EXPECT_FALSE(TableLease::of(table));
  moved = TableLease::of_new(26);
  EXPECT_TRUE(TableLease::of(table));
}

TEST(SharedTable, KeepsScratchOfOneTypeFromLeaseToLease) {
  const auto table = std::make_shared<const SharedTable>(26);
  TableLease::of(table)->scratch<int>() = 7;
  EXPECT_EQ(TableLease::of(table)->scratch<int>(), 7);
  EXPECT_EQ(TableLease::of(table)->scratch<double>(), 0);
  EXPECT_EQ(TableLease::of(table)->scratch<int>(), 0);
}

TEST(SharedTable, OperationsGoOnInAnotherTableWhileItIsLeased) {
  std::uint64_t state = 3;
  const Solid a = to_solid(lattice::surface(lattice::random_cubes(4, state)));
  const Solid b = oblique(0, a);
  for (const BooleanOp operation : kBooleanOps) {
    const Solid expected = boolean(operation, a, b);
    EXPECT_EQ(expected.table, a.table);
    const auto lease = TableLease::of(a.table);
    const Solid other = boolean(operation, a, b);
    EXPECT_NE(other.table, a.table);
    EXPECT_TRUE(same_mesh(to_mesh(other), to_mesh(expected)));
    EXPECT_TRUE(check_operand(other));
    EXPECT_TRUE(same_mesh(to_mesh(resolve(expected).solid), to_mesh(expected)));
    Chain chain(a);
    chain.apply(operation, b);
    EXPECT_TRUE(same_mesh(least(chain.solid()), least(expected)));
    const std::vector<Solid> both{a, b};
    EXPECT_TRUE(
        same_mesh(to_mesh(boolean_all(operation, both)), to_mesh(expected)));
    EXPECT_NE(oblique(1, a).table, a.table);
  }
}

/// What one thread finds of solids that others use too.
struct Found {
  std::vector<ExportedMesh> meshes;
  std::vector<bool> are_fine;
};

Found found(const std::vector<Solid>& solids) {
  Found found;
  for (const Solid& solid : solids) {
    found.are_fine.push_back(check_operand(solid).has_value());
    found.meshes.push_back(least(resolve(solid).solid));
  }
  for (std::size_t i = 0; i + 1 < solids.size(); ++i) {
    for (const BooleanOp operation : kBooleanOps)
      found.meshes.push_back(
          least(boolean(operation, solids[i], solids[i + 1])));
  }
  found.meshes.push_back(least(boolean_all(BooleanOp::kUnion, solids)));
  const Halves halves = split(solids[0], {{{0, 0, 3}, {5, 1, 3}, {1, 5, 4}}});
  found.meshes.push_back(least(halves.positive));
  return found;
}

TEST(SharedTable, EightThreadsUseTheSameSolids) {
  std::uint64_t state = 5;
  std::vector<Solid> solids{
      to_solid(lattice::surface(lattice::random_cubes(4, state)))};
  for (std::int64_t i = 0; i < 4; ++i) {
    solids.push_back(oblique(i, solids[0]));
    solids.push_back(
        boolean(BooleanOp::kUnion, solids[0], oblique(i + 1, solids[0])));
  }
  const Found expected = found(solids);
  std::array<Found, 8> all;
  std::vector<std::thread> threads;
  for (Found& one : all) threads.emplace_back([&] { one = found(solids); });
  for (std::thread& thread : threads) thread.join();
  for (const Found& one : all) {
    EXPECT_EQ(one.are_fine, expected.are_fine);
    ASSERT_EQ(one.meshes.size(), expected.meshes.size());
    for (std::size_t i = 0; i < one.meshes.size(); ++i)
      EXPECT_TRUE(same_mesh(one.meshes[i], expected.meshes[i])) << i;
  }
}

TEST(SharedTable, ADefaultSolidIsAnEmptyOperand) {
  std::uint64_t state = 9;
  const Solid a = to_solid(lattice::surface(lattice::random_cubes(4, state)));
  const Solid none;
  for (const BooleanOp operation : kBooleanOps) {
    const Solid right = boolean(operation, a, none);
    const Solid left = boolean(operation, none, a);
    EXPECT_EQ(!right.faces.empty(), is_member(operation, true, false));
    EXPECT_EQ(!left.faces.empty(), is_member(operation, false, true));
    for (const Solid& one : {left, right}) {
      EXPECT_TRUE(one.faces.empty() || same_mesh(to_mesh(one), to_mesh(a)));
    }
    EXPECT_TRUE(boolean(operation, none, none).faces.empty());
    Chain chain((Solid()));
    chain.apply(operation, a);
    EXPECT_EQ(!chain.solid().faces.empty(), is_member(operation, false, true));
    EXPECT_EQ(boolean_all(operation, std::vector{none, a}).faces.size(),
              left.faces.size());
  }
  EXPECT_TRUE(check_operand(none));
  EXPECT_TRUE(self_intersections(none).empty());
  EXPECT_TRUE(resolve(none).solid.faces.empty());
  EXPECT_TRUE(to_mesh(merge_faces(none, Merge::kPlane)).vertices.empty());
  EXPECT_TRUE(
      split(none, {{{0, 0, 3}, {5, 1, 3}, {1, 5, 4}}}).positive.faces.empty());
  EXPECT_TRUE(complement(none).unbounded);
}

}  // namespace
}  // namespace halfspace::fast
