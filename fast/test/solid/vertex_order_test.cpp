#include "solid/vertex_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace halfspace::fast {
namespace {

bool is_before(const GeometryTable& table, std::int32_t u, std::int32_t v) {
  for (int axis = 0; axis < 3; ++axis) {
    const int order = table.compare(axis, u, v);
    if (order != 0) return order < 0;
  }
  return false;
}

/// Points of the grid and meets of planes that are nearly upright to the first
/// axis: many of either are level along it, or nearly.
std::vector<std::int32_t> vertices_of(GeometryTable& table, std::size_t count,
                                      std::uint64_t most,
                                      std::mt19937_64& random) {
  const auto number = [&](std::uint64_t size) {
    return static_cast<std::int64_t>(random() % (2 * size + 1)) -
           static_cast<std::int64_t>(size);
  };
  const auto is_at = [&](std::int64_t a, std::int64_t b, std::int64_t c,
                         const GridPoint& origin) {
    return table.add_plane(Vector3<Int128>{a, b, c}, origin).plane;
  };
  const auto plane = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
    return is_at(a, b, c, {number(most), number(9), number(9)});
  };
  // k + 1 / q: closer to each other than doubles are, which round either way.
  const auto close = [&] {
    const std::int64_t q = (1 << 23) + number(32), k = (1 << 20) + number(1);
    const std::int64_t z = number(3);
    return table.meet(is_at(q, 1, 0, {k, 1, 0}), is_at(0, 94906267, 0, {}),
                      is_at(0, 0, 94906249 + z, {0, 0, z}));
  };
  std::vector<std::int32_t> vertices;
  while (vertices.size() < count) {
    const auto kind = random() % 3;
    vertices.push_back(
        kind == 0 ? table.add_point({number(most), number(3), number(3)})
        : kind == 1 && most > 1000
            ? close()
            : table.meet(plane(1 << 20, number(1), number(1)),
                         plane(number(1), 3, 0), plane(0, number(1), 7)));
    if (vertices.size() < count) continue;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()),
                   vertices.end());
  }
  std::shuffle(vertices.begin(), vertices.end(), random);
  return vertices;
}

TEST(MeshOrder, IsThatOfExactCoordinates) {
  std::mt19937_64 random(13);
  for (const std::size_t count : {0u, 1u, 2u, 100u, 511u, 512u, 4000u}) {
    for (const std::uint64_t most : {1000u, 1u << 22}) {
      GeometryTable table(26);
      std::vector<std::int32_t> expected =
          vertices_of(table, count, most, random);
      const auto found = vertices_in_order(expected, table);
      std::sort(expected.begin(), expected.end(),
                [&](std::int32_t u, std::int32_t v) {
                  return is_before(table, u, v);
                });
      ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(),
                             expected.end()));
    }
  }
}

TEST(MeshOrder, OfOneLevelIsThatOfTheOtherCoordinates) {
  GeometryTable table(26);
  std::vector<std::int32_t> expected;
  for (std::int64_t y = 0; y < 30; ++y) {
    for (std::int64_t z = 0; z < 30; ++z)
      expected.push_back(table.add_point({7, y, z}));
  }
  std::vector<std::int32_t> shuffled = expected;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937_64(14));
  const auto found = vertices_in_order(shuffled, table);
  EXPECT_TRUE(
      std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
}

}  // namespace
}  // namespace halfspace::fast
