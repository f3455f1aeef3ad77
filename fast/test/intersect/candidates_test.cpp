#include "intersect/candidates.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "halfspace/splitmix.hpp"
#include "intersect/far_rows.hpp"
#include "solid/loops.hpp"

namespace halfspace::fast {
namespace {

/// A face of random loops, and by edge, and for the end, whether a loop begins
/// there. Some begin where the one before them does.
struct Loops {
  Solid solid;
  std::vector<bool> begins;
};

Loops random_loops(std::uint64_t& state) {
  const auto next = [&state](std::uint64_t count) {
    return static_cast<std::int64_t>(mix(++state) % count);
  };
  Loops result;
  Solid& solid = result.solid;
  TableLease lease = TableLease::of_new(26);
  solid.table = lease.shared();
  const std::int64_t loops = 1 + next(12);
  const std::int64_t sizes = 3 + next(40);
  std::int32_t start = 0;
  GridPoint at;
  for (std::int64_t i = 0; i < loops; ++i) {
    if (i == 0 || next(2) == 0) {
      at = {next(40), next(40), 0};
      start = lease.table().add_point(at);
    }
    std::int32_t last = start;
    const auto go_to = [&](std::int32_t to) {
      if (to != last) solid.edges.push_back({last, to, -1});
      last = to;
    };
    for (std::int64_t n = 2 + next(static_cast<std::uint64_t>(sizes)); n > 0;
         --n)
      go_to(lease.table().add_point({at.x + next(6) + 1, at.y + next(6), 0}));
    result.begins.resize(solid.edges.size());
    go_to(start);
    result.begins.resize(solid.edges.size() + 1);
    result.begins.back() = true;
  }
  result.begins[0] = true;
  Face face;
  face.edge_count = static_cast<std::uint32_t>(solid.edges.size());
  face.box = face_box(solid, face);
  solid.faces.push_back(face);
  return result;
}

TEST(FarRows, OfAFaceAreAsLongAsCanBe) {
  std::uint64_t state = 7;
  int parts = 0, wholes = 0;
  for (int i = 0; i < 4000; ++i) {
    SCOPED_TRACE("face " + std::to_string(i));
    const auto [solid, begins] = random_loops(state);
    Solid beside;
    beside.faces.emplace_back();
    for (std::size_t k = 0; k < 2; ++k) {
      Box& box = beside.faces[0].box;
      box.low[k] = static_cast<float>(mix(++state) % 40);
      box.high[k] = box.low[k] + static_cast<float>(mix(++state) % 30);
    }
    Operand operand, other;
    operand.solid = &solid;
    other.solid = &beside;
    BooleanScratch scratch;
    prepare(operand, other, scratch);
    operand.active = {0};
    add_edges(operand, *solid.table);
    const bool has_many = operand.blocks->of(0) != nullptr;
    const auto goes_on = [&edges = solid.edges](std::uint32_t edge) {
      return edges[edge - 1].to == edges[edge].from;
    };
    std::vector<bool> is_far(solid.edges.size());
    FarRows::Row before;
    bool was_whole = false;
    FarRows rows(operand, 0);
    while (const auto row = rows.next()) {
      ASSERT_LE(before.last, row->first);
      ASSERT_LT(row->first, row->last);
      ASSERT_LE(row->last, solid.edges.size());
      const bool is_whole = begins[row->first] && begins[row->last];
      ++(is_whole ? wholes : parts);
      for (std::uint32_t e = row->first; e < row->last; ++e) {
        is_far[e] = true;
        EXPECT_TRUE(e == row->first || goes_on(e) || (is_whole && has_many));
      }
      // As long as can be.
      if (row->first > 0 && row->first == before.last) {
        EXPECT_FALSE(goes_on(row->first));
        EXPECT_FALSE(was_whole && is_whole && has_many);
      }
      before = *row;
      was_whole = is_whole;
    }
    for (std::size_t e = 0; e < is_far.size(); ++e)
      EXPECT_EQ(is_far[e], operand.edge_of[e] < 0);
  }
  EXPECT_GT(parts, 1000);
  EXPECT_GT(wholes, 1000);
}

}  // namespace
}  // namespace halfspace::fast
