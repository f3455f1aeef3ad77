#include "solid/dynamic_bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "boxed_faces.hpp"

namespace halfspace::fast {
namespace {

TEST(DynamicBvh, FindsWhatIsThere) {
  std::mt19937_64 random(9);
  Solid solid;
  DynamicBvh index;
  std::set<std::int32_t> gone;
  std::size_t found_in_all = 0;
  for (int step = 0; step < 600; ++step) {
    const auto first = static_cast<std::int32_t>(solid.faces.size());
    // Now and then none, or many.
    const std::size_t more = step % 150 == 149 ? 300 : random() % 6;
    for (const Face& face : boxed_faces(random, more, 60).faces)
      solid.faces.push_back(face);
    index.add(solid, first);
    if (step % 2 != 0 && !solid.faces.empty()) {
      const auto f = static_cast<std::int32_t>(random() % solid.faces.size());
      index.remove(f);
      gone.insert(f);
    }
    // Layers are put together after 7, 63 and 511 others.
    if (step % 8 > 1) continue;
    for (const Box& box : boxes_of(boxed_faces(random, 1, 200))) {
      std::vector<std::int32_t> found;
      index.find(box, [&](std::int32_t f) { found.push_back(f); });
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, overlapping(solid, box, gone)) << step;
      found_in_all += found.size();
    }
  }
  EXPECT_GT(gone.size(), 200u);
  EXPECT_GT(found_in_all, 50000u);
}

}  // namespace
}  // namespace halfspace::fast
