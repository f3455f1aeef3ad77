#include "solid/loops.hpp"

#include <gtest/gtest.h>

#include "table/shared_table.hpp"

namespace halfspace::fast {
namespace {

TEST(Loops, ALoopAlongALineIsNothing) {
  GeometryTable table(26);
  const std::int32_t p = table.add_point({0, 0, 0});
  const std::int32_t q = table.add_point({3, 0, 0});
  const std::int32_t r = table.add_point({9, 0, 0});
  List<DirectedEdge> pieces{{0, 0, p, r}, {0, 0, r, q}, {0, 0, q, p}};
  // Nothing turns at the others.
  drop_collinear_vertices(
      pieces, [p](std::int32_t v) { return v == p; }, table);
  EXPECT_TRUE(pieces.empty());
}

}  // namespace
}  // namespace halfspace::fast
