#include <gtest/gtest.h>

#include <string>

#include "boolean/nonsense.hpp"
#include "cases.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {
namespace {

/// Whether both planes of every edge hold its ends.
bool is_held(const Solid& solid) {
  const auto is_in = [&](std::int32_t v, std::int32_t plane) {
    return plane < 0 || solid.table->side(plane, v) == 0;
  };
  for (const Face& face : solid.faces) {
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const SolidEdge& edge = solid.edges[face.first_edge + i];
      for (const std::int32_t v : {edge.from, edge.to}) {
        if (!is_in(v, face.plane) || !is_in(v, edge.other)) return false;
      }
    }
  }
  return true;
}

TEST(BooleanNonsense, EveryBooleanOfClosedSurfacesEnds) {
  std::size_t refused = 0, open = 0;
  // The last one merges the faces of an open surface.
  const std::uint64_t count = cases(150);
  for (std::uint64_t i = 1; i <= count; ++i) {
    const std::uint64_t seed = i < count ? i : 20254;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Solid a = nonsense(seed);
    Solid b = nonsense(seed + 7000, &a);
    const bool fine = check_operand(a) && check_operand(b);
    if (!fine) ++refused;
    if (seed % 2 == 0) {
      a = merge_faces(a, Merge::kPlane);
      b = merge_faces(b, Merge::kPlane);
    }
    for (const BooleanOp operation :
         {BooleanOp::kUnion, BooleanOp::kIntersection,
          BooleanOp::kDifference}) {
      const Solid result = boolean(operation, a, b, 1 + seed % 2);
      const bool is_closed =
          bad_edges(result).empty() && open_faces(result).empty();
      EXPECT_TRUE(is_closed || !fine);
      if (!is_closed) ++open;
      // What comes of it is nonsense as well, and goes on to be worked on.
      const Result<Done> said = check_operand(result);
      EXPECT_TRUE(said || !said.error().message.empty());
      const Solid least = merge_faces(result, Merge::kPlane);
      EXPECT_TRUE(is_held(result) && is_held(least));
      if (is_closed) to_mesh(least, {.triangles = true});
      EXPECT_TRUE(is_held(boolean(operation, least, b)));
      Chain chain(result);
      chain.apply(operation, b);
      EXPECT_TRUE(is_held(chain.solid()));
    }
    boolean(BooleanOp::kSymmetricDifference, a, b);
    split(a, {GridPoint{0, 0, 1}, GridPoint{1, 0, 1}, GridPoint{0, 1, 2}});
  }
  // Most are what they are meant to be.
  EXPECT_GT(refused, cases(100));
  EXPECT_GT(open, cases(150));
}

}  // namespace
}  // namespace halfspace::fast
