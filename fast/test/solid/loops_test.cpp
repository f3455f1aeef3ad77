#include "solid/loops.hpp"

#include <gtest/gtest.h>

#include "table/geometry_table.hpp"

namespace halfspace::fast {
namespace {

TEST(Loops, ALoopAlongALineIsNothing) {
  Space space(26);
  const std::int32_t p = space.add_point({0, 0, 0});
  const std::int32_t q = space.add_point({3, 0, 0});
  const std::int32_t r = space.add_point({9, 0, 0});
  List<Piece> pieces{{0, 0, p, r}, {0, 0, r, q}, {0, 0, q, p}};
  // Nothing turns at the others.
  straighten(
      pieces, [p](std::int32_t v) { return v == p; }, space);
  EXPECT_TRUE(pieces.empty());
}

}  // namespace
}  // namespace halfspace::fast
