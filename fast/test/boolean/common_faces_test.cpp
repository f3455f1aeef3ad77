#include "boolean/common_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "base/sanitizer.hpp"
#include "cases.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "intersect/candidates.hpp"
#include "lattice.hpp"

namespace halfspace::fast {
namespace {

using lattice::Cubes;

/// How many faces of the first operand are common, of one kind.
std::ptrdiff_t count_of(Operand::Common kind, const Solid& a, const Solid& b) {
  std::array<Operand, 2> operands;
  operands[0].solid = &a;
  operands[1].solid = &b;
  BooleanScratch scratch;
  prepare(operands[0], operands[1], scratch);
  find_common_faces(operands[0], operands[1], scratch);
  const auto& first = operands[0].common;
  const auto& second = operands[1].common;
  EXPECT_EQ(std::count(first.begin(), first.end(), kind),
            std::count(second.begin(), second.end(), kind));
  return std::count(first.begin(), first.end(), kind);
}

Cubes cubes_of_both(BooleanOp operation, const Cubes& a, const Cubes& b) {
  Cubes result;
  for (std::size_t i = 0; i < result.full.size(); ++i)
    result.full[i] = is_member(operation, a.full[i], b.full[i]);
  return result;
}

/// The cubes with a few others, or without a few.
Cubes with_changes(Cubes cubes, int changes, std::uint64_t& state) {
  for (int k = 0; k < changes; ++k) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    bool& cube = cubes.full[(state >> 33) % cubes.full.size()];
    cube = !cube;
  }
  return cubes;
}

void expect_these(const Solid& solid, const Cubes& cubes) {
  ASSERT_TRUE(bad_edges(solid).empty());
  ASSERT_TRUE(open_faces(solid).empty());
  bool whole = false;
  ASSERT_TRUE(lattice::outline(solid, whole) == lattice::outline(cubes));
  ASSERT_TRUE(whole);
  ASSERT_TRUE(lattice::is_least(merge_faces(solid, Merge::kPlane)));
}

TEST(CommonFaces, WhatBothHaveIsCombinedAsAnythingElse) {
  std::uint64_t state = 5;
  std::ptrdiff_t same = 0, opposite = 0, active = 0;
  for (std::size_t pair = 0; pair < cases(60); ++pair) {
    SCOPED_TRACE("pair " + std::to_string(pair));
    const int lump = pair % 3 == 0 ? 1 : pair % 3 == 1 ? 2 : 4;
    const Cubes a = lattice::random_cubes(lump, state);
    const Cubes b = with_changes(a, static_cast<int>(pair % 6), state);
    Solid first = to_solid(lattice::surface(a));
    Solid second = to_solid(lattice::surface(b), first);
    // Of what is left of all cubes, the faces are turned round.
    Cubes rest;
    for (std::size_t i = 0; i < rest.full.size(); ++i)
      rest.full[i] = !b.full[i];
    const Solid third = to_solid(lattice::surface(rest), first);
    if (pair % 4 == 3) {
      first = merge_faces(std::move(first), Merge::kPlane);
      second = merge_faces(std::move(second), Merge::kPlane);
    }
    same += count_of(Operand::kSame, first, second);
    opposite += count_of(Operand::kOpposite, first, third);
    active += static_cast<std::ptrdiff_t>(first.faces.size()) -
              count_of(Operand::kSame, first, second);
    for (const BooleanOp operation : kBooleanOps) {
      ASSERT_NO_FATAL_FAILURE(expect_these(boolean(operation, first, second),
                                           cubes_of_both(operation, a, b)));
      ASSERT_NO_FATAL_FAILURE(expect_these(boolean(operation, first, third),
                                           cubes_of_both(operation, a, rest)));
      const bool is_bounded = !is_member(operation, true, false);
      Solid outer = boolean(operation, complement(second), first);
      Cubes cubes = cubes_of_both(operation, rest, a);
      if (!is_bounded) {
        outer = complement(std::move(outer));
        for (bool& cube : cubes.full) cube = !cube;
      }
      ASSERT_NO_FATAL_FAILURE(expect_these(outer, cubes));
      Chain chain(first);
      chain.apply(operation, second);
      ASSERT_NO_FATAL_FAILURE(
          expect_these(chain.solid(), cubes_of_both(operation, a, b)));
    }
  }
  // Some are common, either way round, and some are near others.
  const std::ptrdiff_t least = kSanitized ? 200 : 1000;
  EXPECT_GT(same, least);
  EXPECT_GT(opposite, least);
  EXPECT_GT(active, least);
}

TEST(CommonFaces, OfASolidWithItselfAreAll) {
  std::uint64_t state = 6;
  for (std::size_t k = 0; k < cases(10); ++k) {
    const Solid solid = to_solid(lattice::surface(
        lattice::random_cubes(1 + static_cast<int>(k % 3), state)));
    const auto all = static_cast<std::ptrdiff_t>(solid.faces.size());
    EXPECT_EQ(count_of(Operand::kSame, solid, solid), all);
    EXPECT_EQ(count_of(Operand::kOpposite, solid, complement(solid)), all);
    EXPECT_EQ(boolean(BooleanOp::kUnion, solid, solid).edges, solid.edges);
    EXPECT_TRUE(boolean(BooleanOp::kDifference, solid, solid).faces.empty());
  }
}

}  // namespace
}  // namespace halfspace::fast
