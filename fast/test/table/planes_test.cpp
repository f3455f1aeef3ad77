#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "table/shared_table.hpp"

namespace halfspace::fast {
namespace {

/// A point in a plane: `origin + i u + j v`.
GridPoint point_at(const GridPoint& origin, const GridPoint& u,
                   const GridPoint& v, std::int64_t i, std::int64_t j) {
  return {origin.x + i * u.x + j * v.x, origin.y + i * u.y + j * v.y,
          origin.z + i * u.z + j * v.z};
}

TEST(Planes, PlanesThatAreEqualAreOne) {
  std::mt19937_64 random(7);
  for (const int bits : {26, 40, 54}) {
    GeometryTable table(bits);
    std::set<std::int32_t> known;
    for (int round = 0; round < 400; ++round) {
      // Small numbers make many planes parallel, large ones fill the grid.
      const std::int64_t most =
          round % 2 == 0 ? 3 : (std::int64_t{1} << (bits - 1)) / 32;
      const auto number = [&] {
        return static_cast<std::int64_t>(
                   random() % static_cast<std::uint64_t>(2 * most + 1)) -
               most;
      };
      const auto point = [&] {
        return GridPoint{number(), number(), number()};
      };
      const GridPoint o = point(), u = point(), v = point();
      if (cross<54>({u.x, u.y, u.z}, {v.x, v.y, v.z}) == Vector3<Int128>{})
        continue;
      const OrientedPlane one = table.add_plane(
          {o, point_at(o, u, v, 1, 0), point_at(o, u, v, 0, 1)});
      known.insert(one.plane);
      const std::size_t count = table.plane_count();
      ASSERT_EQ(count, known.size());
      for (int k = 0; k < 8; ++k) {
        const auto times = [&] {
          return static_cast<std::int64_t>(random() % 13) - 6;
        };
        const std::int64_t a = times(), b = times(), c = times(), d = times();
        if (a * d == b * c) continue;
        const GridPoint p = point_at(o, u, v, times(), times());
        const OrientedPlane other = table.add_plane(
            {p, point_at(p, u, v, a, b), point_at(p, u, v, c, d)});
        ASSERT_EQ(other.plane, one.plane);
        ASSERT_EQ(other.flipped == one.flipped, a * d > b * c);
      }
      ASSERT_EQ(table.plane_count(), count);
      // What is beside it, and parallel, is another plane.
      const auto n = table.normal(one.plane);
      const GridPoint beside = n.x != 0   ? GridPoint{o.x + 1, o.y, o.z}
                               : n.y != 0 ? GridPoint{o.x, o.y + 1, o.z}
                                          : GridPoint{o.x, o.y, o.z + 1};
      const OrientedPlane parallel = table.add_plane(
          {beside, point_at(beside, u, v, 1, 0), point_at(beside, u, v, 0, 1)});
      ASSERT_NE(parallel.plane, one.plane);
      known.insert(parallel.plane);
    }
  }
}

/// Offsets right between two cells of the table, which doubles take to either
/// side: with the normal (2^17, 1, 0), those that are odd.
TEST(Planes, PlanesAtTheBordersOfCellsAreOne) {
  std::mt19937_64 random(12);
  const auto number = [&](std::int64_t most) {
    return static_cast<std::int64_t>(random() %
                                     static_cast<std::uint64_t>(2 * most + 1)) -
           most;
  };
  const GridPoint u{1, -(1 << 17), 0}, v{0, 0, 1};
  GeometryTable table(26);
  for (int round = 0; round < 100; ++round) {
    const GridPoint o{number(100), 2 * number(1 << 22) + 1, number(1 << 23)};
    const std::int32_t plane =
        table.add_plane({o, point_at(o, u, v, 1, 0), point_at(o, u, v, 0, 1)})
            .plane;
    for (int k = 0; k < 20; ++k) {
      const std::int64_t a = number(100), b = number(1 << 24), c = number(100),
                         d = number(1 << 24);
      if (a * d == b * c) continue;
      ASSERT_EQ(
          table.add_plane({o, point_at(o, u, v, a, b), point_at(o, u, v, c, d)})
              .plane,
          plane);
    }
  }
}

}  // namespace
}  // namespace halfspace::fast
