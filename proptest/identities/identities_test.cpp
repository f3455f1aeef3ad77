#include "identities.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "../agree_solids.hpp"
#include "halfspace/fast/boolean.hpp"
#include "placing.hpp"

namespace halfspace::identities {
namespace {

using agree::Draws;
using agree::kSolidKinds;
using agree::SolidKind;
using fast::Solid;

/// Two solids in one table.
std::pair<Solid, Solid> fast_pair(
    const std::pair<halfspace::Solid, halfspace::Solid>& pair) {
  Solid first = fast::to_solid(pair.first, 0);
  Solid second = fast::to_solid(pair.second, first, 1);
  return {std::move(first), std::move(second)};
}

TEST(Identities, HoldInEveryPosition) {
  Draws draws(6);
  std::size_t positions = 0;
  for (const SolidKind kind : kSolidKinds) {
    const halfspace::Solid a = agree::random_solid(kind, 12, draws);
    const halfspace::Solid b =
        agree::random_solid(SolidKind::kSkewed, 12, draws);
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
  EXPECT_EQ(positions, 5u * (4 + 8));
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
      result.faces.back().turned = !result.faces.back().turned;
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
