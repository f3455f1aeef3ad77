#include "solid/grid_prefilter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "boxed_faces.hpp"

namespace halfspace::fast {
namespace {

TEST(GridPrefilter, DropNoFaceThatOverlapsAnother) {
  std::mt19937_64 random(5);
  // In boxes that hold all, some, and in one that is flat.
  const std::array<Box, 3> reaches{Box{{-300, -300, -300}, {800, 800, 800}},
                                   Box{{0, 100, 50}, {90, 500, 60}},
                                   Box{{-300, 7, -300}, {800, 7, 800}}};
  for (const int size : {4, 40, 400}) {
    for (const Box& reach : reaches) {
      const Solid a = boxed_faces(random, 700, size);
      const Solid b = boxed_faces(random, 600, size);
      std::vector<std::int32_t> first = all_of(a);
      std::vector<std::int32_t> second = all_of(b);
      grid_prefilter(a, first, b, second, reach);
      const std::set<std::int32_t> left(first.begin(), first.end());
      const std::set<std::int32_t> right(second.begin(), second.end());
      std::size_t pairs = 0;
      for (const std::int32_t f : all_of(a)) {
        for (const std::int32_t g : all_of(b)) {
          if (!overlap(a.faces[static_cast<std::size_t>(f)].box,
                       b.faces[static_cast<std::size_t>(g)].box))
            continue;
          ++pairs;
          ASSERT_TRUE(left.count(f) != 0 && right.count(g) != 0);
        }
      }
      ASSERT_GT(pairs + static_cast<std::size_t>(size == 4), 0u);
    }
  }
}

TEST(GridPrefilter, DropMostOfWhatIsFar) {
  std::mt19937_64 random(6);
  Solid a = boxed_faces(random, 1000, 4);
  Solid b = boxed_faces(random, 1000, 4);
  for (std::size_t i = 0; i < 900; ++i) {
    for (Box* box : {&a.faces[i].box, &b.faces[i].box}) {
      // A box of the one is far to the left, of the other far to the right.
      const float x = box == &a.faces[i].box ? -2000.0f : 3000.0f;
      box->low[0] = x;
      box->high[0] = x + 1;
    }
  }
  std::vector<std::int32_t> first = all_of(a);
  std::vector<std::int32_t> second = all_of(b);
  grid_prefilter(a, first, b, second, {{-2000, -300, -300}, {3001, 800, 800}});
  EXPECT_LE(first.size(), 100u);
  EXPECT_LE(second.size(), 100u);
}

}  // namespace
}  // namespace halfspace::fast
