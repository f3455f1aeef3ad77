#include "halfspace/exact.hpp"

#include <gtest/gtest.h>

#include "halfspace/halfspace.hpp"

namespace halfspace {
namespace {

TEST(FaceExact, ASolidIsThereInFull) {
  const Solid part =
      Solid::box({0, 0, 0}, {2, 2, 2}) - Solid::box({1, 1, 1}, {3, 3, 3});
  const exact::Solid solid = *exact::solid_of(part);
  EXPECT_EQ(solid.faces.size(), 9u);
  EXPECT_TRUE(exact::bad_edges(solid).empty());
  // From there on under the names that the reference has, too.
  const exact::Solid corner = exact::boolean(
      BooleanOp::kDifference, exact::to_solid(GridSolid(), solid), solid);
  EXPECT_TRUE(corner.faces.empty());
  EXPECT_EQ(exact::solid_of(~part).error().code, ErrorCode::kUnbounded);
  // An empty solid without a table is an operand like any other.
  EXPECT_EQ(
      exact::boolean(BooleanOp::kUnion, solid, exact::Solid{}).faces.size(),
      9u);
}

}  // namespace
}  // namespace halfspace
