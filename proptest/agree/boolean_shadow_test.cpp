#include <gtest/gtest.h>

#include <string>

#include "generate/random_solids.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/shadow/boolean.hpp"

namespace halfspace::agree {
namespace {

TEST(AgreeBooleanShadow, RightResultsHaveNoMismatchAndWrongOnesHave) {
  Draws draws(4);
  shadow::BooleanReport right, wrong;
  shadow::BooleanOptions how;
  how.share = 1;
  std::size_t differ = 0, found = 0;
  for (int round = 0; round < 4; ++round) {
    for (const SolidKind first : kSolidKinds) {
      for (const SolidKind second : kSolidKinds) {
        how.seed = draws.next();
        const auto a = fast::to_solid(random_solid(first, 12, draws));
        const auto b = fast::to_solid(random_solid(second, 12, draws), a);
        for (const BooleanOp operation : kBooleanOps) {
          const auto result = shadow::boolean(operation, a, b, how, right);
          ASSERT_EQ(right.mismatches, 0u)
              << shadow::to_string(right.first.front());
          // The result is an operand, too.
          shadow::boolean(operation, b, result, how, right);
          ASSERT_EQ(right.mismatches, 0u)
              << shadow::to_string(right.first.front());
          // Another operation's result is a wrong one.
          if (operation == BooleanOp::kUnion) continue;
          const auto all = fast::boolean(BooleanOp::kUnion, a, b);
          if (all.faces.size() == result.faces.size()) continue;
          ++differ;
          const std::size_t before = wrong.mismatches;
          shadow::check(operation, a, b, all, how, wrong);
          found += wrong.mismatches > before ? 1 : 0;
        }
      }
    }
  }
  EXPECT_EQ(right.checked, right.operations);
  EXPECT_GT(right.points, 10000u);
  EXPECT_GT(differ, 50u);
  EXPECT_GT(10 * found, 9 * differ);
  ASSERT_EQ(wrong.first.size(), how.kept);
  EXPECT_EQ(wrong.first[0].reproducer.find("union"), std::string::npos);
  EXPECT_NE(wrong.first[0].reproducer.find("solid "), std::string::npos);
}

TEST(AgreeBooleanShadow, TheShareIsKept) {
  Draws draws(5);
  const auto a =
      fast::to_solid(random_solid(SolidKind::kTetrahedra, 12, draws));
  const auto b =
      fast::to_solid(random_solid(SolidKind::kTetrahedra, 12, draws), a);
  shadow::BooleanReport report;
  shadow::BooleanOptions how;
  how.share = 0.1;
  for (int i = 0; i < 200; ++i)
    shadow::boolean(BooleanOp::kUnion, a, b, how, report);
  EXPECT_EQ(report.operations, 200u);
  EXPECT_EQ(report.checked, 20u);
  EXPECT_EQ(report.mismatches, 0u);
}

}  // namespace
}  // namespace halfspace::agree
