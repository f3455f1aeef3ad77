#include "box/bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "boxed_faces.hpp"

namespace halfspace::fast {
namespace {

TEST(Bvh, FindsJustWhatOverlaps) {
  std::mt19937_64 random(8);
  // Levels are full, and one more; items are sorted from some number on.
  for (const std::size_t count :
       {0u, 1u, 7u, 8u, 9u, 64u, 65u, 256u, 257u, 513u, 4097u}) {
    Solid solid = boxed_faces(random, count, 90);
    // A half-space's face is everywhere.
    if (count > 8) solid.faces[5].box = {kEmptyBox.high, kEmptyBox.low};
    const BoxTree tree(
        [&](std::int32_t f) -> const Box& {
          return solid.faces[static_cast<std::size_t>(f)].box;
        },
        all_of(solid));
    for (const Box& box : boxes_of(boxed_faces(random, 40, 200))) {
      std::vector<std::int32_t> found;
      tree.find(box, [&](std::int32_t f) { found.push_back(f); });
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, overlapping(solid, box)) << count;
    }
    // All pairs, each once.
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs, expected;
    for (std::size_t packet = 0; packet < tree.packet_count(); ++packet) {
      tree.find_pairs(packet, [&](std::int32_t f, std::int32_t g) {
        pairs.emplace_back(std::min(f, g), std::max(f, g));
      });
    }
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t f = 0; f < count; ++f) {
      for (const std::int32_t g : overlapping(solid, solid.faces[f].box)) {
        if (static_cast<std::size_t>(g) > f)
          expected.emplace_back(static_cast<std::int32_t>(f), g);
      }
    }
    ASSERT_EQ(pairs, expected) << count;
  }
}

}  // namespace
}  // namespace halfspace::fast
