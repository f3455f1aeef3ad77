#include "identities.hpp"

#include <gtest/gtest.h>

#include <array>
#include <iterator>
#include <string>
#include <utility>

#include "generate/random_solids.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/ref/boolean.hpp"
#include "placing.hpp"
#include "troubled_pairs.hpp"
#include "volume.hpp"

namespace halfspace::identities {
namespace {

using agree::Draws;
using agree::kSolidKinds;
using agree::SolidKind;
using fast::Solid;

/// Two solids in one table.
std::pair<Solid, Solid> fast_pair(const std::pair<GridSolid, GridSolid>& pair) {
  Solid first = fast::to_solid(pair.first, 0);
  Solid second = fast::to_solid(pair.second, first, 1);
  return {std::move(first), std::move(second)};
}

TEST(Identities, HoldInEveryPosition) {
  Draws draws(6);
  std::size_t positions = 0;
  for (const SolidKind kind : kSolidKinds) {
    const GridSolid a = agree::random_solid(kind, 12, draws);
    const GridSolid b = agree::random_solid(SolidKind::kSkewed, 12, draws);
    for (const auto& [x, y] : {std::pair(&a, &b), std::pair(&a, &a)}) {
      for (const Position position : kPositions) {
        SCOPED_TRACE(name_of(position));
        const auto pair = placed(*x, *y, position);
        if (!pair) continue;
        ++positions;
        const auto [first, second] = fast_pair(*pair);
        const auto broken = broken_identities(first, second, shipped);
        ASSERT_TRUE(broken.empty()) << broken.front();
      }
    }
  }
  EXPECT_EQ(positions, std::size(kSolidKinds) * (4 + 8));
}

TEST(Identities, HoldForTroubledPairs) {
  Draws draws(10);
  for (const Trouble trouble : kTroubles) {
    for (int i = 0; i < 6; ++i) {
      SCOPED_TRACE(std::string(name_of(trouble)) + ", " + std::to_string(i));
      const auto [first, second] = fast_pair(troubled_pair(trouble, draws));
      for (const Solid* solid : {&first, &second}) {
        const Result<Done> fine = fast::check_operand(*solid);
        ASSERT_TRUE(fine) << fine.error().message;
      }
      const auto broken = broken_identities(first, second, shipped);
      ASSERT_TRUE(broken.empty()) << broken.front();
    }
  }
}

/// fast::boolean() with a fault planted.
Solid wrong(int fault, BooleanOp operation, const Solid& a, const Solid& b) {
  if (fault == 0 && operation == BooleanOp::kDifference)
    operation = BooleanOp::kIntersection;
  Solid result = fast::boolean(operation, a, b);
  if (result.faces.empty()) return result;
  switch (fault) {
    case 1:
      result.faces.pop_back();
      break;
    case 2:
      result.faces.back().flipped = !result.faces.back().flipped;
      break;
    case 3:
      // A union that is told to be the first operand's alone.
      for (fast::Face& face : result.faces) face.polygon = 0;
      break;
    case 4:
      if (operation == BooleanOp::kUnion) result = a;
      break;
    default:
      break;
  }
  return result;
}

TEST(Identities, AreBrokenByWrongBooleans) {
  Draws draws(7);
  std::array<int, 5> found{};
  for (int round = 0; round < 4; ++round) {
    const auto pair = placed(agree::random_solid(SolidKind::kSkewed, 12, draws),
                             agree::random_solid(SolidKind::kBox, 12, draws),
                             Position::kGeneral);
    ASSERT_TRUE(pair);
    const auto [first, second] = fast_pair(*pair);
    ASSERT_TRUE(broken_identities(first, second, shipped).empty());
    for (int fault = 0; fault < 5; ++fault) {
      const auto broken = broken_identities(
          first, second,
          [fault](BooleanOp operation, const Solid& a, const Solid& b) {
            return wrong(fault, operation, a, b);
          });
      found[static_cast<std::size_t>(fault)] += broken.empty() ? 0 : 1;
    }
  }
  for (const int count : found) EXPECT_GE(count, 3);
}

TEST(Identities, VolumesAreExact) {
  Draws draws(9);
  for (const SolidKind kind : kSolidKinds) {
    const auto a = agree::random_solid(kind, 12, draws);
    const Solid whole = fast::to_solid(a);
    VolumeSum sum;
    sum.add(whole, 2);
    sum.add(whole, 1);
    EXPECT_TRUE(sum.times6() ==
                ref::Rational(3) * ref::volume6(ref::to_solid(a)));
  }
  // A cube of 3 steps, less what is beyond x + 2 y + 4 z = 5.
  const auto cube = [](std::int64_t size) {
    SceneData data;
    for (int i = 0; i < 8; ++i)
      data.vertices.push_back(
          {size * (i & 1), size * (i >> 1 & 1), size * (i >> 2)});
    data.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                    2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    data.first_corner = {0, 4, 8, 12, 16, 20, 24};
    data.colors.resize(6);
    return fast::to_solid(*make_solid(*make_scene(std::move(data))));
  };
  const Solid large = cube(3);
  const fast::Halves halves =
      fast::split(large, {{{5, 0, 0}, {1, 2, 0}, {1, 0, 1}}});
  VolumeSum part;
  part.add(halves.positive, 1);
  // The plane's pyramid in the corner, 5^3/(1*2*4), less those of its tips
  // beyond x = 3, 2^3/8.
  const ref::Rational tip = ref::Rational(125 - 8) / ref::Rational(8);
  EXPECT_TRUE(part.times6() == tip ||
              part.times6() == ref::Rational(6 * 27) - tip);
  part.add(halves.negative, 1);
  EXPECT_TRUE(part.times6() == 6 * 27);
}

TEST(Identities, EdgesInTheWrongFaceAreAFault) {
  Draws draws(8);
  const Solid box =
      fast::to_solid(agree::random_solid(SolidKind::kBox, 12, draws));
  EXPECT_TRUE(faults_of(box).empty());
  // The edges of all faces together are as before.
  Solid torn = box;
  std::swap(torn.edges[torn.faces[0].first_edge],
            torn.edges[torn.faces[1].first_edge]);
  EXPECT_FALSE(faults_of(torn).empty());
}

}  // namespace
}  // namespace halfspace::identities
